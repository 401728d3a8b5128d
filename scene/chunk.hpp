// A chunk of geometry, as it is drawn: lattice points with a colour, and triangles.
#pragma once

#include "scene/skeleton.hpp"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// 16 bytes, as the graphics card reads it.
struct ChunkVertex {
  glm::ivec3 point;  ///< on the chunk's lattice
  uint32_t color;    ///< index into the palette
  bool operator==(const ChunkVertex&) const = default;
};
static_assert(sizeof(ChunkVertex) == 16);

struct Chunk {
  std::vector<ChunkVertex> vertices;
  std::vector<uint32_t> indices;  ///< three a triangle, counter-clockwise from outside

  size_t triangle_count() const { return indices.size() / 3; }
  LatticeBox box() const;
};

/// Reorders for the vertex cache and compresses with meshoptimizer's codecs (Arseny Kapoulkine). Degenerate
/// triangles stay. The chunk must hold at least one triangle, indices in range.
std::vector<std::byte> encode_chunk(const Chunk& chunk);

/// Reads back what encode_chunk wrote. Error (place) for bytes that do not decode, or that hold other counts,
/// indices out of range, colours beyond palette_size or points outside info.box.
Chunk decode_chunk(std::span<const std::byte> bytes, const ChunkInfo& info, size_t palette_size,
                   const std::string& place);

}  // namespace triptych
