#include "render/gl/vertex_layout.hpp"

#include "render/draw_list.hpp"
#include "scene/chunk.hpp"

#include <cstddef>
#include <cstring>

namespace triptych {

namespace {
constexpr GLuint normals_attribute = 10, coordinates_attribute = 11, light_attribute = 12;
}

std::vector<std::byte> interleaved(const Chunk& chunk, const VertexStreams& streams) {
  std::vector<std::byte> bytes(chunk.vertices.size() * streams.stride());
  std::byte* to = bytes.data();
  const auto add = [&](const auto& value) {
    std::memcpy(to, &value, sizeof(value));
    to += sizeof(value);
  };
  for (size_t i = 0; i < chunk.vertices.size(); ++i) {
    add(chunk.vertices[i]);
    if (streams.colored) add(chunk.colors[i]);
    if (streams.normals) add(chunk.normals.empty() ? VertexNormal{} : chunk.normals[i]);
    if (streams.textured) add(chunk.coordinates[i]);
    if (streams.lit) add(chunk.light.empty() ? VertexLight{} : chunk.light[i]);
  }
  return bytes;
}

void describe_vertices(GLuint vertex_array, const VertexStreams& streams) {
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
  size_t offset = sizeof(ChunkVertex);
  if (streams.colored) {
    glVertexArrayAttribFormat(vertex_array, attribute, 4, GL_UNSIGNED_BYTE, GL_TRUE,
                              static_cast<GLuint>(offset));
    add(vertices_stream);
    offset += sizeof(VertexColor);
  }
  attribute = normals_attribute;
  if (streams.normals) {
    add_integers(vertices_stream, 2, GL_UNSIGNED_SHORT, offset);
    offset += sizeof(VertexNormal);
  }
  attribute = coordinates_attribute;
  if (streams.textured) {
    add_integers(vertices_stream, 2, GL_INT, offset);
    offset += sizeof(TextureCoordinates);
  }
  attribute = light_attribute;
  if (streams.lit) {
    glVertexArrayAttribFormat(vertex_array, attribute, 4, GL_UNSIGNED_BYTE, GL_TRUE,
                              static_cast<GLuint>(offset));
    add(vertices_stream);
  }
  glVertexArrayBindingDivisor(vertex_array, records_stream, 1);
}

}  // namespace triptych
