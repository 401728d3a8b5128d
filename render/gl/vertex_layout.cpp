#include "render/gl/vertex_layout.hpp"

#include "render/draw_list.hpp"
#include "scene/chunk.hpp"

#include <cstddef>
#include <cstring>

namespace triptych {

namespace {
constexpr GLuint normals_attribute = 10;
}

std::vector<std::byte> VertexLayout::bytes_of(const Chunk& chunk) const {
  std::vector<std::byte> bytes(chunk.vertices.size() * stride());
  std::byte* to = bytes.data();
  for (size_t i = 0; i < chunk.vertices.size(); ++i, to += stride()) {
    std::memcpy(to, &chunk.vertices[i], sizeof(ChunkVertex));
    if (colors) std::memcpy(to + colors_at(), &chunk.colors[i], sizeof(VertexColor));
    if (normals && !chunk.normals.empty())
      std::memcpy(to + normals_at(), &chunk.normals[i], sizeof(VertexNormal));
  }
  return bytes;
}

void describe_vertices(GLuint vertex_array, const VertexLayout& layout) {
  GLuint attribute = 0;
  const auto add = [&](GLuint stream) {
    glVertexArrayAttribBinding(vertex_array, attribute, stream);
    glEnableVertexArrayAttrib(vertex_array, attribute);
    ++attribute;
  };
  const auto add_integers = [&](GLuint stream, GLint count, GLenum type, size_t offset) {
    glVertexArrayAttribIFormat(vertex_array, attribute, count, type, static_cast<GLuint>(offset));
    add(stream);
  };
  add_integers(vertices_stream, 3, GL_INT, offsetof(ChunkVertex, point));
  add_integers(vertices_stream, 1, GL_UNSIGNED_INT,
               sizeof(ChunkVertex) - sizeof(uint32_t));  // colour and piece
  for (size_t row = 0; row < 3; ++row) {
    glVertexArrayAttribFormat(vertex_array, attribute, 4, GL_FLOAT, GL_FALSE,
                              static_cast<GLuint>(offsetof(DrawRecord, rows) + row * sizeof(glm::vec4)));
    add(records_stream);
  }
  add_integers(records_stream, 3, GL_INT, offsetof(DrawRecord, cell));
  add_integers(records_stream, 1, GL_UNSIGNED_INT, offsetof(DrawRecord, item));
  add_integers(records_stream, 1, GL_UNSIGNED_INT, offsetof(DrawRecord, first_bound));
  add_integers(records_stream, 1, GL_UNSIGNED_INT, offsetof(DrawRecord, cut));
  if (layout.colors) {
    glVertexArrayAttribFormat(vertex_array, attribute, 4, GL_UNSIGNED_BYTE, GL_TRUE,
                              static_cast<GLuint>(layout.colors_at()));
    add(vertices_stream);
  }
  attribute = normals_attribute;
  if (layout.normals) add_integers(vertices_stream, 2, GL_UNSIGNED_SHORT, layout.normals_at());
  glVertexArrayBindingDivisor(vertex_array, records_stream, 1);
}

}  // namespace triptych
