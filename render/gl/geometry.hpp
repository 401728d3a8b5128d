// Geometry in device memory: chunks of a pack, uploaded when they are first drawn.
#pragma once

#include "render/draw_list.hpp"
#include "render/gl/objects.hpp"
#include "residency/residency.hpp"

#include <span>
#include <vector>

namespace triptych {

/// Vertices and indices of the chunks uploaded so far, in growing buffers, and the palette. Chunks whose
/// vertices have colours have buffers of vertices of their own.
class Geometry {
 public:
  Geometry(const Skeleton& skeleton, Residency& residency);

  /// Requests the chunks that are needed and not uploaded yet from the residency, and uploads them. Error for
  /// a damaged chunk, or where OpenGL has no memory left.
  void require(std::span<const DrawItem> items);
  void require(uint32_t chunk);
  std::span<const ChunkRange> ranges() const { return ranges_; }

  /// Bytes of device memory in use.
  uint64_t memory_bytes() const {
    return vertices_.capacity + indices_.capacity + colored_vertices_.capacity + colors_.capacity;
  }
  /// Binds vertex array and palette for drawing, of chunks whose vertices have colours or of the others.
  /// records: a buffer with a DrawRecord for each base instance.
  void bind(GLuint records, bool colored) const;

 private:
  struct Arena {
    GlBuffer buffer;
    uint64_t used = 0, capacity = 0;
    /// Appends; returns the offset. The buffer is replaced by a larger one when it is full.
    uint64_t append(std::span<const std::byte> bytes);
  };
  void upload(uint32_t chunk, const Chunk& geometry);
  void attach_buffers();

  const Skeleton& skeleton_;
  Residency& residency_;
  std::vector<ChunkRange> ranges_;
  Arena vertices_, indices_, colored_vertices_, colors_;
  GlBuffer palette_;
  GlVertexArray vertex_array_, colored_vertex_array_;
};

}  // namespace triptych
