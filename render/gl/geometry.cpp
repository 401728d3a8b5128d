#include "render/gl/geometry.hpp"

#include "base/error.hpp"
#include "render/gl/shaders.hpp"
#include "render/gl/vertex_layout.hpp"

#include <algorithm>
#include <limits>

namespace triptych {

uint64_t Geometry::Arena::append(std::span<const std::byte> bytes) {
  constexpr uint64_t smallest = 16 << 20;
  if (used + bytes.size() > capacity) {
    const uint64_t grown = std::max({smallest, capacity * 2, used + bytes.size()});
    GlBuffer larger;
    glNamedBufferStorage(larger, static_cast<GLsizeiptr>(grown), nullptr, GL_DYNAMIC_STORAGE_BIT);
    check_gl("device memory");
    if (used > 0) glCopyNamedBufferSubData(buffer, larger, 0, 0, static_cast<GLsizeiptr>(used));
    std::swap(buffer, larger);
    capacity = grown;
  }
  const uint64_t offset = used;
  glNamedBufferSubData(buffer, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes.size()),
                       bytes.data());
  used += bytes.size();
  return offset;
}

Geometry::Geometry(const Skeleton& skeleton, Residency& residency)
    : skeleton_(skeleton), residency_(residency), ranges_(skeleton.chunks.size()) {
  const auto& palette = skeleton_.palette;
  // Colours as floats: 16 bytes an entry, read by the vertex stage.
  std::vector<float> colors;
  for (const auto& color : palette) {
    for (const uint8_t channel : color) colors.push_back(static_cast<float>(channel) / 255);
  }
  glNamedBufferStorage(palette_, static_cast<GLsizeiptr>(colors.size() * sizeof(float)), colors.data(), 0);
  describe_vertices(vertex_array_);
  describe_vertices(colored_vertex_array_, true);
}

void Geometry::attach_buffers() {
  glVertexArrayVertexBuffer(vertex_array_, vertices_stream, vertices_.buffer, 0, sizeof(ChunkVertex));
  glVertexArrayElementBuffer(vertex_array_, indices_.buffer);
  if (colors_.used == 0) return;
  glVertexArrayVertexBuffer(colored_vertex_array_, vertices_stream, colored_vertices_.buffer, 0,
                            sizeof(ChunkVertex));
  glVertexArrayVertexBuffer(colored_vertex_array_, colors_stream, colors_.buffer, 0, sizeof(VertexColor));
  glVertexArrayElementBuffer(colored_vertex_array_, indices_.buffer);
}

void Geometry::upload(uint32_t chunk, const Chunk& geometry) {
  const bool colored = !geometry.colors.empty();
  Arena& vertices = colored ? colored_vertices_ : vertices_;
  const uint64_t vertex = vertices.append(std::as_bytes(std::span(geometry.vertices)));
  if (colored) colors_.append(std::as_bytes(std::span(geometry.colors)));
  const uint64_t index = indices_.append(std::as_bytes(std::span(geometry.indices)));
  if (index / sizeof(uint32_t) > UINT32_MAX || vertex / sizeof(ChunkVertex) > INT32_MAX) {
    fail("device memory", "more geometry than one buffer can address");
  }
  ranges_[chunk] = {static_cast<uint32_t>(index / sizeof(uint32_t)),
                    static_cast<uint32_t>(geometry.indices.size()),
                    static_cast<uint32_t>(vertex / sizeof(ChunkVertex)), geometry.outward_runs, colored};
}

void Geometry::require(std::span<const DrawItem> items) {
  for (const DrawItem& item : items) require(item.chunk);
}

void Geometry::require(uint32_t chunk) {
  if (ranges_[chunk].loaded()) return;
  residency_.request(chunk, 0);
  residency_.pump(std::numeric_limits<double>::infinity());
  upload(chunk, *residency_.pin(chunk));
  residency_.unpin(chunk);
  residency_.evict(chunk);  // it is in device memory now
  attach_buffers();
}

void Geometry::bind(GLuint records, bool colored) const {
  const GLuint vertex_array = colored ? colored_vertex_array_ : vertex_array_;
  glVertexArrayVertexBuffer(vertex_array, records_stream, records, 0, sizeof(DrawRecord));
  glBindVertexArray(vertex_array);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, palette_binding, palette_);
}

}  // namespace triptych
