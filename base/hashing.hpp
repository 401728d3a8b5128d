// 64-bit checksums and digests: XXH3 (xxHash, Yann Collet).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace triptych {

/// XXH3-64 of the bytes.
uint64_t hash_bytes(std::span<const std::byte> bytes, uint64_t seed = 0);

template <typename Value>
uint64_t hash_values(std::span<const Value> values, uint64_t seed = 0) {
  return hash_bytes(std::as_bytes(values), seed);
}

}  // namespace triptych
