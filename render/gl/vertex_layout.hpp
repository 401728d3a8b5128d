// Where the vertex stage's attributes come from.
#pragma once

#include "scene/chunk.hpp"

#include <glad/gl.h>

namespace triptych {

inline constexpr GLuint vertices_stream = 0;  ///< binding of a buffer of ChunkVertex, or ColoredVertex
inline constexpr GLuint records_stream = 1;   ///< of a buffer with a DrawRecord for each base instance

/// A vertex of a chunk whose vertices have colours.
struct ColoredVertex {
  ChunkVertex vertex;
  VertexColor color;
};
static_assert(sizeof(ColoredVertex) == 20);

/// Describes them for the geometry vertex shader, and colours if there are any, and enables their attributes.
void describe_vertices(GLuint vertex_array, bool colored = false);

}  // namespace triptych
