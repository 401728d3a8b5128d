// Where the vertex stage's attributes come from.
#pragma once

#include "scene/chunk.hpp"

#include <cstddef>
#include <glad/gl.h>
#include <vector>

namespace triptych {

inline constexpr GLuint vertices_stream = 0;  ///< binding of a buffer of vertices (VertexStreams)
inline constexpr GLuint records_stream = 1;   ///< of a buffer with a DrawRecord for each base instance

/// What vertices of a chunk have besides a ChunkVertex; in a buffer it follows that, in this order. The
/// chunks of a pack in which any has normals, or baked light, all have room for them, so that commands of one
/// draw need not differ in it.
struct VertexStreams {
  bool colored = false;   ///< a VertexColor
  bool normals = false;   ///< a VertexNormal
  bool textured = false;  ///< TextureCoordinates
  bool lit = false;       ///< a VertexLight

  /// Bytes of a vertex.
  size_t stride() const {
    return sizeof(ChunkVertex) + (colored ? sizeof(VertexColor) : 0) + (normals ? sizeof(VertexNormal) : 0) +
           (textured ? sizeof(TextureCoordinates) : 0) + (lit ? sizeof(VertexLight) : 0);
  }
};

/// Vertices as a buffer has them.
std::vector<std::byte> interleaved(const Chunk& chunk, const VertexStreams& streams);

/// Describes them for the geometry vertex shader, and enables their attributes.
void describe_vertices(GLuint vertex_array, const VertexStreams& streams = {});

}  // namespace triptych
