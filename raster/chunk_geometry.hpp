// Geometry as the rasteriser reads it: chunks of a pack, kept once something wants to be drawn.
#pragma once

#include "lod/representation.hpp"
#include "residency/residency.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace triptych {

/// What vertices lead to, so that vectors can be read at the last of them.
inline constexpr size_t spare_vertices = 16;

class RasterChunk {
 public:
  explicit RasterChunk(const Chunk& chunk);

  uint32_t vertex_count() const { return static_cast<uint32_t>(piece.size()); }
  /// The vertices of some triangles, and perhaps others: from first to last, both included.
  struct VertexRange {
    uint32_t first, last;
  };
  VertexRange vertices(uint32_t first_triangle, uint32_t triangle_count) const;
  uint64_t bytes() const;
  /// Whether backs of the triangle cannot be seen from outside of the chunk's box (Chunk::outward).
  bool is_outward(size_t triangle) const { return outward[triangle / 32] >> triangle % 32 & 1; }
  uint32_t layer(size_t triangle) const { return layers.empty() ? 0 : layers[triangle]; }

  std::vector<int32_t> x, y, z;           ///< of each vertex, on the chunk's lattice; and spare ones
  std::vector<uint8_t> piece;             ///< of each vertex, index into the chunk's pieces
  std::vector<uint32_t> corner[3];        ///< of each triangle: indices of vertices; and spare ones
  std::vector<uint32_t> color;            ///< of each triangle, index into the palette
  std::vector<uint8_t> layers;            ///< of each triangle ChunkVertex::layer; empty if all are 0
  std::vector<VertexColor> vertex_color;  ///< of each vertex, in place of `color`; empty if it has none
  std::vector<uint32_t> outward;          ///< of each triangle a bit, the lowest first; and spare ones
  bool has_outward = false;

 private:
  std::vector<VertexRange> ranges_;  ///< of blocks of triangles
};

/// The chunks that were asked for so far.
class ChunkGeometry {
 public:
  ChunkGeometry(const Skeleton& skeleton, Residency& residency);

  /// Asks the residency for the chunks that are needed and are not here. Error for a damaged chunk.
  void require(std::span<const DrawItem> items);
  void require(uint32_t chunk);
  const RasterChunk& chunk(uint32_t index) const { return *chunks_[index]; }

  uint64_t memory_bytes() const { return bytes_; }

 private:
  Residency& residency_;
  std::vector<std::unique_ptr<const RasterChunk>> chunks_;  ///< null where it was not asked for
  uint64_t bytes_ = 0;
};

}  // namespace triptych
