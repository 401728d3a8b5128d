// Where the vertex stage's attributes come from.
#pragma once

#include <glad/gl.h>

namespace triptych {

inline constexpr GLuint vertices_stream = 0;  ///< binding of a buffer of ChunkVertex
inline constexpr GLuint records_stream = 1;   ///< of a buffer with a DrawRecord for each base instance

/// Describes both for the geometry vertex shader, and enables their attributes.
void describe_vertices(GLuint vertex_array);

}  // namespace triptych
