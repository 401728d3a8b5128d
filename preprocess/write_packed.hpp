// Arrays as packs hold them: coded by meshoptimizer, after their size.
#pragma once

#include "base/bytes.hpp"

#include <cstdint>
#include <meshoptimizer.h>
#include <span>
#include <vector>

namespace triptych {

/// A u32 size in bytes, 0 for no values, and so many bytes by meshopt_encodeVertexBuffer with the size of a
/// value as the vertex size.
template <typename Value>
void write_packed(const std::vector<Value>& values, ByteWriter& writer) {
  std::vector<uint8_t> code;
  if (!values.empty()) {
    code.resize(meshopt_encodeVertexBufferBound(values.size(), sizeof(Value)));
    code.resize(
        meshopt_encodeVertexBuffer(code.data(), code.size(), values.data(), values.size(), sizeof(Value)));
  }
  writer.write(static_cast<uint32_t>(code.size()));
  writer.write_all(std::span<const uint8_t>(code));
}

}  // namespace triptych
