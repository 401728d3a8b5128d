#include "render/gl/geometry.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "render/gl/shaders.hpp"
#include "render/gl/vertex_layout.hpp"
#include "residency/take.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// At most what all chunks of a pack take.
uint64_t bytes_of_all(const Skeleton& skeleton, const VertexStreams& most) {
  uint64_t bytes = 0;
  for (const ChunkInfo& chunk : skeleton.chunks) {
    bytes += (uint64_t{chunk.vertex_count} + 2) * most.stride() +
             uint64_t{chunk.triangle_count} * 3 * sizeof(uint32_t);
  }
  return bytes;
}

}  // namespace

Geometry::Geometry(const Skeleton& skeleton, Residency& residency)
    : skeleton_(skeleton),
      residency_(residency),
      ranges_(skeleton.chunks.size()),
      places_(skeleton.chunks.size()),
      cache_(skeleton.chunks.size()),
      textures_(skeleton, residency),
      normals_(has_normals(skeleton.effects)),
      lit_(has_baked_light(skeleton.effects)) {
  const auto& palette = skeleton_.palette;
  // Colours as floats: 16 bytes an entry, read by the vertex stage.
  std::vector<float> colors;
  for (const auto& color : palette) {
    for (const uint8_t channel : color) colors.push_back(static_cast<float>(channel) / 255);
  }
  glNamedBufferStorage(palette_, static_cast<GLsizeiptr>(colors.size() * sizeof(float)), colors.data(), 0);
  if (!skeleton.materials.empty()) {
    glNamedBufferStorage(materials_,
                         static_cast<GLsizeiptr>(skeleton.materials.size() * sizeof(SurfaceMaterial)),
                         skeleton.materials.data(), 0);
  }
  for (const bool colored : {false, true}) {
    for (const bool textured : {false, true})
      describe_vertices(vertex_arrays_[colored ? 1 : 0][textured ? 1 : 0], streams(colored, textured));
  }
}

void Geometry::begin_view() {
  cache_.begin_view();
  textures_.begin_view();
  if (cap_ == cache_.use().cap) return;
  cache_.set_cap(cap_);
  if (cap_ == no_cap) return;
  const uint64_t size = std::min(cap_, bytes_of_all(skeleton_, streams(true, !skeleton_.textures.empty())));
  if (size < space_.size()) {  // smaller than what is there: it begins anew
    while (cache_.least_recently_used() != ChunkCache::none) drop(cache_.least_recently_used());
    space_ = {};
  }
  make_buffer(size);
}

void Geometry::make_buffer(uint64_t bytes) {
  GlBuffer other;
  glNamedBufferStorage(other, static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_STORAGE_BIT);
  check_gl("device memory");
  if (space_.size() > 0)
    glCopyNamedBufferSubData(buffer_, other, 0, 0, static_cast<GLsizeiptr>(space_.size()));
  std::swap(buffer_, other);
  space_.grow(bytes);
  for (const bool colored : {false, true}) {
    for (const bool textured : {false, true}) {
      const GLuint vertex_array = vertex_arrays_[colored ? 1 : 0][textured ? 1 : 0];
      glVertexArrayVertexBuffer(vertex_array, vertices_stream, buffer_, 0,
                                static_cast<GLsizei>(streams(colored, textured).stride()));
      glVertexArrayElementBuffer(vertex_array, buffer_);
    }
  }
}

bool Geometry::try_place(Place& place, uint64_t stride) {
  const auto vertices = space_.take(place.vertex_bytes, stride);
  if (!vertices) return false;
  const auto indices = space_.take(place.index_bytes, sizeof(uint32_t));
  if (!indices) {
    space_.give_back(*vertices, place.vertex_bytes);
    return false;
  }
  place.vertices = *vertices;
  place.indices = *indices;
  return true;
}

Geometry::Place Geometry::place(uint64_t vertex_bytes, uint64_t stride, uint64_t index_bytes) {
  constexpr uint64_t smallest = 32 << 20;
  Place place{.vertex_bytes = vertex_bytes, .index_bytes = index_bytes};
  const uint64_t bytes = vertex_bytes + index_bytes;
  for (uint32_t old; (old = cache_.next_to_go(bytes)) != ChunkCache::none;) drop(old);
  while (!try_place(place, stride)) {
    if (cache_.use().cap == no_cap) {
      make_buffer(std::max({smallest, 2 * space_.size(), space_.size() + bytes + stride}));
      continue;
    }
    // There is room, but not in one place.
    const uint32_t old = cache_.least_recently_used();
    if (old == ChunkCache::none) throw NoRoom(cache_.use().view_bytes + bytes, cache_.use().cap);
    drop(old);
  }
  return place;
}

void Geometry::drop(uint32_t chunk) {
  const Place& place = places_[chunk];
  space_.give_back(place.vertices, place.vertex_bytes);
  space_.give_back(place.indices, place.index_bytes);
  ranges_[chunk] = {};
  cache_.remove(chunk);
}

void Geometry::write(uint64_t offset, std::span<const std::byte> bytes) {
  glNamedBufferSubData(buffer_, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes.size()),
                       bytes.data());
}

void Geometry::load(uint32_t chunk) {
  const Stopwatch stopwatch;
  const ChunkInfo& info = skeleton_.chunks[chunk];
  const uint64_t at_least = uint64_t{info.vertex_count} * streams(false, false).stride() +
                            uint64_t{info.triangle_count} * 3 * sizeof(uint32_t);
  try {
    cache_.next_to_go(at_least);  // what has no room is not read
  } catch (const NoRoom&) {
    if (missing_.refuse) throw;
    return cache_.leave_out(true);
  }
  const std::optional<Chunk> taken = take(residency_, chunk, missing_, cache_);
  if (!taken) return cache_.leave_out(false);
  const Chunk& geometry = *taken;
  const VertexStreams streams = this->streams(!geometry.colors.empty(), !geometry.coordinates.empty());
  const bool plain = streams.stride() == sizeof(ChunkVertex);
  const std::vector<std::byte> laid_out = plain ? std::vector<std::byte>() : interleaved(geometry, streams);
  const auto vertices = plain ? std::as_bytes(std::span(geometry.vertices)) : std::span(laid_out);
  const auto indices = std::as_bytes(std::span(geometry.indices));
  const uint64_t stride = streams.stride();
  Place where;
  try {
    where = place(vertices.size(), stride, indices.size());
  } catch (const NoRoom&) {
    if (missing_.refuse) throw;
    return cache_.leave_out(true);
  }
  if (where.indices / sizeof(uint32_t) > UINT32_MAX || where.vertices / stride > INT32_MAX)
    fail("device memory", "more geometry than one buffer can address");
  write(where.vertices, vertices);
  write(where.indices, indices);
  places_[chunk] = where;
  ranges_[chunk] = {static_cast<uint32_t>(where.indices / sizeof(uint32_t)),
                    static_cast<uint32_t>(geometry.indices.size()),
                    static_cast<uint32_t>(where.vertices / stride),
                    geometry.outward_runs,
                    streams.colored,
                    geometry.normals_from,
                    transparent_runs(geometry, skeleton_)};
  ranges_[chunk].layered =
      std::ranges::any_of(geometry.vertices, [](const ChunkVertex& vertex) { return vertex.layer > 0; });
  ranges_[chunk].lit = !geometry.light.empty();
  find_materials(geometry, ranges_[chunk]);
  cache_.add(chunk, vertices.size() + indices.size(), skeleton_.chunks[chunk].size, stopwatch.milliseconds());
}

/// What the chunk calls for beyond its colours.
void Geometry::find_materials(const Chunk& chunk, ChunkRange& range) const {
  if (skeleton_.materials.empty()) return;
  range.textured = !chunk.coordinates.empty();
  std::vector<uint32_t> colors;
  for (const ChunkVertex& vertex : chunk.vertices) colors.push_back(vertex.color);
  std::ranges::sort(colors);
  colors.erase(std::unique(colors.begin(), colors.end()), colors.end());
  for (const uint32_t color : colors) {
    const SurfaceMaterial& material = skeleton_.materials[color];
    range.emissive |= material.is_emissive();
    range.cut_out |= range.textured && material.cutoff > 0;
    for (const uint32_t texture : {material.texture, material.emission_texture})
      if (range.textured && texture != SurfaceMaterial::no_texture) range.textures.push_back(texture);
  }
}

uint64_t Geometry::require_textures(std::span<const DrawItem> items) {
  uint64_t bytes = 0;
  for (const DrawItem& item : items) {
    for (const uint32_t texture : ranges_[item.chunk].textures) bytes += textures_.require(texture);
  }
  return bytes;
}

void Geometry::require(std::span<const DrawItem> items) {
  if (missing_.wait) {  // all of them are read side by side
    for (const DrawItem& item : items)
      if (!ranges_[item.chunk].loaded() && !cache_.is_damaged(item.chunk))
        residency_.expect(item.chunk, urgent);
  }
  for (const DrawItem& item : items) require(item.chunk);
}

void Geometry::require(uint32_t chunk) {
  if (ranges_[chunk].loaded()) {
    cache_.touch(chunk);
  } else {
    load(chunk);
  }
}

void Geometry::bind(GLuint records, const DrawGroup& group) const {
  const GLuint vertex_array = vertex_arrays_[group.colored ? 1 : 0][group.textured ? 1 : 0];
  glVertexArrayVertexBuffer(vertex_array, records_stream, records, 0, sizeof(DrawRecord));
  glBindVertexArray(vertex_array);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, palette_binding, palette_);
  if (!group.textured && !group.emissive) return;
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, materials_binding, materials_);
  if (group.textured) textures_.bind();
}

}  // namespace triptych
