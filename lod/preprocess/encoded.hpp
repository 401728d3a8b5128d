// A chunk that waits, encoded, for its turn to be written: threads encode, one writes in a fixed order.
#pragma once

#include "scene/pack.hpp"
#include "scene/surface.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace triptych {

struct EncodedChunk {
  std::vector<std::byte> bytes;
  uint32_t vertices = 0, triangles = 0;
  LatticeBox box;
};

inline EncodedChunk encode(const Surface& surface) {
  const Chunk chunk = make_chunk(surface);
  return {encode_chunk(chunk), static_cast<uint32_t>(chunk.vertices.size()),
          static_cast<uint32_t>(chunk.triangle_count()), chunk.box()};
}

/// Returns the chunk's index in the pack.
inline uint32_t append(PackWriter& writer, const EncodedChunk& chunk, uint32_t lattice) {
  return writer.add_encoded_chunk(chunk.bytes, chunk.vertices, chunk.triangles, chunk.box, lattice);
}

}  // namespace triptych
