// Where the vertex stage's attributes come from.
#pragma once

#include "scene/chunk.hpp"

#include <cstddef>
#include <glad/gl.h>
#include <vector>

namespace triptych {

inline constexpr GLuint vertices_stream = 0;  ///< binding of a buffer of vertices, as VertexLayout says
inline constexpr GLuint records_stream = 1;   ///< of a buffer with a DrawRecord for each base instance

/// What follows each ChunkVertex: its colour, and its normal. The chunks of a pack in which any has normals
/// all have room for them, so that commands of one draw need not differ in it.
struct VertexLayout {
  bool colors = false, normals = false;

  size_t stride() const { return sizeof(ChunkVertex) + (colors ? sizeof(VertexColor) : 0) + normal_bytes(); }
  size_t colors_at() const { return sizeof(ChunkVertex); }
  size_t normals_at() const { return stride() - normal_bytes(); }
  /// The chunk's vertices laid out so.
  std::vector<std::byte> bytes_of(const Chunk& chunk) const;

 private:
  size_t normal_bytes() const { return normals ? sizeof(VertexNormal) : 0; }
};

/// Describes them for the geometry vertex shader, and enables their attributes.
void describe_vertices(GLuint vertex_array, const VertexLayout& layout = {});

}  // namespace triptych
