// A chunk that waits, encoded, for its turn to be written: threads encode, one writes in a fixed order.
#pragma once

#include "lod/preprocess/pieces.hpp"
#include "scene/pack.hpp"
#include "scene/surface.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
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

/// One chunk, or, if `in_pieces`, one for each piece of a surface whose box is mostly air.
inline std::vector<EncodedChunk> encode_pieces(const Surface& surface, bool in_pieces) {
  std::vector<EncodedChunk> chunks;
  if (in_pieces) {
    for (const Surface& piece : fitting_pieces(surface)) chunks.push_back(encode(piece));
  }
  if (chunks.empty()) chunks.push_back(encode(surface));
  return chunks;
}

/// Chunks that lie one after the other in the pack.
struct ChunkRange {
  uint32_t first = 0, count = 0;
  uint64_t triangles = 0;  ///< of all of them
};

inline ChunkRange append(PackWriter& writer, std::span<const EncodedChunk> chunks, uint32_t lattice) {
  ChunkRange range;
  for (const EncodedChunk& chunk : chunks) {
    const uint32_t index =
        writer.add_encoded_chunk(chunk.bytes, chunk.vertices, chunk.triangles, chunk.box, lattice);
    if (range.count++ == 0) range.first = index;
    range.triangles += chunk.triangles;
  }
  return range;
}

}  // namespace triptych
