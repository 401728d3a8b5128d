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
}

void Geometry::attach_buffers() {
  glVertexArrayVertexBuffer(vertex_array_, vertices_stream, vertices_.buffer, 0, sizeof(ChunkVertex));
  glVertexArrayElementBuffer(vertex_array_, indices_.buffer);
}

void Geometry::upload(uint32_t chunk, const Chunk& geometry) {
  const uint64_t vertex = vertices_.append(std::as_bytes(std::span(geometry.vertices)));
  const uint64_t index = indices_.append(std::as_bytes(std::span(geometry.indices)));
  if (index / sizeof(uint32_t) > UINT32_MAX || vertex / sizeof(ChunkVertex) > INT32_MAX) {
    fail("device memory", "more geometry than one buffer can address");
  }
  ranges_[chunk] = {static_cast<uint32_t>(index / sizeof(uint32_t)),
                    static_cast<uint32_t>(geometry.indices.size()),
                    static_cast<uint32_t>(vertex / sizeof(ChunkVertex)), geometry.outward_runs};
}

void Geometry::require(std::span<const DrawItem> items) {
  bool changed = false;
  for (const DrawItem& item : items) {
    if (ranges_[item.chunk].loaded()) continue;
    residency_.request(item.chunk, 0);
    residency_.pump(std::numeric_limits<double>::infinity());
    upload(item.chunk, *residency_.pin(item.chunk));
    residency_.unpin(item.chunk);
    residency_.evict(item.chunk);  // it is in device memory now
    changed = true;
  }
  if (changed) attach_buffers();
}

void Geometry::bind(GLuint records) const {
  glVertexArrayVertexBuffer(vertex_array_, records_stream, records, 0, sizeof(DrawRecord));
  glBindVertexArray(vertex_array_);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, palette_binding, palette_);
}

}  // namespace triptych
