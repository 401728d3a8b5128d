// Geometry as the rasteriser reads it: chunks of a pack, kept within a cap once something wants to be drawn.
#pragma once

#include "lod/representation.hpp"
#include "residency/chunk_cache.hpp"
#include "residency/residency.hpp"
#include "scene/transparency.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace triptych {

/// What vertices lead to, so that vectors can be read at the last of them.
inline constexpr size_t spare_vertices = 16;

class RasterChunk {
 public:
  RasterChunk(const Chunk& chunk, Palette palette);

  uint32_t vertex_count() const { return static_cast<uint32_t>(piece.size()); }
  /// The vertices of some triangles, and perhaps others: from first to last, both included.
  struct VertexRange {
    uint32_t first, last;
  };
  VertexRange vertices(uint32_t first_triangle, uint32_t triangle_count) const;
  uint64_t bytes() const;
  /// About what it will take, more rather than less, before it is read; textured: it may have coordinates;
  /// lit: baked light.
  static uint64_t bytes_of(const ChunkInfo& info, bool textured, bool lit);
  /// Whether backs of the triangle cannot be seen from outside of the chunk's box (Chunk::outward).
  bool is_outward(size_t triangle) const { return outward[triangle / 32] >> triangle % 32 & 1; }
  uint32_t layer(size_t triangle) const { return layers.empty() ? 0 : layers[triangle]; }

  std::vector<int32_t> x, y, z;           ///< of each vertex, on the chunk's lattice; and spare ones
  std::vector<uint8_t> piece;             ///< of each vertex, index into the chunk's pieces
  std::vector<uint32_t> corner[3];        ///< of each triangle: indices of vertices; and spare ones
  std::vector<uint32_t> color;            ///< of each triangle, index into the palette
  std::vector<uint8_t> layers;            ///< of each triangle ChunkVertex::layer; empty if all are 0
  std::vector<VertexColor> vertex_color;  ///< of each vertex, in place of `color`; empty if it has none
  /// Of each vertex Chunk::normals; empty if it has none.
  std::vector<VertexNormal> vertex_normal;
  ChunkNormals normals_from = ChunkNormals::none;
  /// Of each vertex, as Chunk::coordinates.
  std::vector<TextureCoordinates> coordinates;
  std::vector<VertexLight> light;  ///< of each vertex, as Chunk::light
  std::vector<uint32_t> outward;   ///< of each triangle a bit, the lowest first; and spare ones
  bool has_outward = false;
  std::vector<uint32_t> transparent;  ///< transparent_runs()
  std::vector<uint32_t> cut_out;      ///< cut_out_runs(); empty where it has no coordinates

 private:
  std::vector<VertexRange> ranges_;  ///< of blocks of triangles
};

/// The chunks that were asked for last.
class ChunkGeometry {
 public:
  ChunkGeometry(const Skeleton& skeleton, Residency& residency);

  /// Chunks that only earlier views needed may go from now on.
  void begin_view() {
    cache_.begin_view();
    make_room(0);  // the cap may have been lowered
  }
  /// Asks the residency for the chunks that are needed and are not here, or does without them. Error for a
  /// damaged chunk, NoRoom where the view needs more than the cap.
  void require(std::span<const DrawItem> items);
  void require(uint32_t chunk);
  /// One that was required for the current view: it stays until the next view begins. Null where it is to be
  /// done without.
  const RasterChunk* chunk(uint32_t index) const { return chunks_[index].get(); }

  void set_cap(uint64_t bytes) { cache_.set_cap(bytes); }
  void set_missing(const MissingChunks& missing) { missing_ = missing; }
  const GeometryUse& use() const { return cache_.use(); }
  bool has(uint32_t chunk) const { return cache_.has(chunk); }
  bool is_damaged(uint32_t chunk) const { return cache_.is_damaged(chunk); }

 private:
  void load(uint32_t chunk);
  void make_room(uint64_t bytes);

  const Skeleton& skeleton_;
  Residency& residency_;
  std::vector<std::unique_ptr<const RasterChunk>> chunks_;  ///< null where it is not here
  ChunkCache cache_;
  MissingChunks missing_;
};

}  // namespace triptych
