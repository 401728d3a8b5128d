// Where the vertex stage's attributes come from.
#pragma once

#include <glad/gl.h>

namespace triptych {

inline constexpr GLuint vertices_stream = 0;  ///< binding of a buffer of ChunkVertex
inline constexpr GLuint records_stream = 1;   ///< of a buffer with a DrawRecord for each base instance
inline constexpr GLuint colors_stream = 2;    ///< of a buffer of VertexColor, one for each ChunkVertex

/// Describes the first two for the geometry vertex shader, and colours if there are any, and enables their
/// attributes.
void describe_vertices(GLuint vertex_array, bool colored = false);

}  // namespace triptych
