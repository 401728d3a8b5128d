// Where the vertex stage's attributes come from.
#pragma once

#include "scene/chunk.hpp"

#include <cstddef>
#include <glad/gl.h>
#include <vector>

namespace triptych {

inline constexpr GLuint vertices_stream = 0;  ///< binding of a buffer of vertices (VertexStreams)
inline constexpr GLuint records_stream = 1;   ///< of a buffer with a DrawRecord for each base instance

/// What vertices of a chunk have besides a ChunkVertex; in a buffer it follows that, in this order.
struct VertexStreams {
  bool colored = false;   ///< a VertexColor
  bool textured = false;  ///< TextureCoordinates
  bool operator==(const VertexStreams&) const = default;

  static constexpr size_t kinds = 4;
  size_t index() const { return (colored ? 1 : 0) + (textured ? 2 : 0); }
  static VertexStreams of_index(size_t index) { return {(index & 1) != 0, (index & 2) != 0}; }
  /// Bytes of a vertex.
  size_t stride() const {
    return sizeof(ChunkVertex) + (colored ? sizeof(VertexColor) : 0) +
           (textured ? sizeof(TextureCoordinates) : 0);
  }
};

/// Vertices as a buffer has them.
std::vector<std::byte> interleaved(const Chunk& chunk, const VertexStreams& streams);

/// Describes them for the geometry vertex shader, and enables their attributes.
void describe_vertices(GLuint vertex_array, const VertexStreams& streams = {});

}  // namespace triptych
