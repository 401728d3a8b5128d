#include "raster/chunk_geometry.hpp"

#include "base/clock.hpp"
#include "residency/take.hpp"

#include <algorithm>

namespace triptych {

namespace {

constexpr uint32_t block = 64;  ///< triangles

template <typename Value>
uint64_t capacity_of(const std::vector<Value>& values) {
  return values.capacity() * sizeof(Value);
}

}  // namespace

RasterChunk::RasterChunk(const Chunk& chunk, Palette palette)
    : vertex_color(chunk.colors),
      vertex_normal(chunk.normals),
      normals_from(chunk.normals_from),
      coordinates(chunk.coordinates),
      light(chunk.light),
      transparent(transparent_runs(chunk, palette)),
      cut_out(chunk.coordinates.empty() ? std::vector<uint32_t>() : cut_out_runs(chunk, palette)) {
  const size_t vertices = chunk.vertices.size(), triangles = chunk.triangle_count();
  for (auto* const values : {&x, &y, &z}) values->reserve(vertices + spare_vertices);
  for (auto& values : corner) values.reserve(triangles + spare_vertices);
  piece.reserve(vertices);
  color.reserve(triangles);
  ranges_.reserve((triangles + block - 1) / block);
  for (const ChunkVertex& vertex : chunk.vertices) {
    x.push_back(vertex.point.x);
    y.push_back(vertex.point.y);
    z.push_back(vertex.point.z);
    piece.push_back(static_cast<uint8_t>(vertex.piece));
  }
  for (size_t i = 0; i + 2 < chunk.indices.size(); i += 3) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t vertex = chunk.indices[i + k];
      corner[k].push_back(vertex);
      if (i % (3 * block) == 0 && k == 0) ranges_.push_back({vertex, vertex});
      VertexRange& range = ranges_.back();
      range = {std::min(range.first, vertex), std::max(range.last, vertex)};
    }
    // Colours are of triangles: as in OpenGL, the last corner's.
    color.push_back(chunk.vertices[chunk.indices[i + 2]].color);
  }
  if (std::ranges::any_of(chunk.vertices, [](auto& vertex) { return vertex.layer > 0; })) {
    layers.reserve(triangles);
    for (size_t i = 2; i < chunk.indices.size(); i += 3)
      layers.push_back(chunk.vertices[chunk.indices[i]].layer);
  }
  outward.resize(color.size() / 32 + 2);
  const std::vector<bool> is_outward = chunk.outward();
  for (size_t i = 0; i < is_outward.size(); ++i) outward[i / 32] |= uint32_t{is_outward[i]} << i % 32;
  has_outward = chunk.outward_runs.size() > 0;
  for (auto* const values : {&x, &y, &z}) values->resize(values->size() + spare_vertices);
  for (auto& values : corner) values.resize(values.size() + spare_vertices);
}

RasterChunk::VertexRange RasterChunk::vertices(uint32_t first_triangle, uint32_t triangle_count) const {
  VertexRange result{vertex_count(), 0};
  if (triangle_count == 0) return result;
  for (uint32_t i = first_triangle / block; i <= (first_triangle + triangle_count - 1) / block; ++i)
    result = {std::min(result.first, ranges_[i].first), std::max(result.last, ranges_[i].last)};
  return result;
}

uint64_t RasterChunk::bytes() const {
  uint64_t sum = sizeof *this + capacity_of(x) + capacity_of(y) + capacity_of(z) + capacity_of(piece) +
                 capacity_of(color) + capacity_of(outward) + capacity_of(ranges_) + capacity_of(layers) +
                 capacity_of(vertex_color) + capacity_of(vertex_normal) + capacity_of(coordinates) +
                 capacity_of(light) + capacity_of(transparent) + capacity_of(cut_out);
  for (const auto& values : corner) sum += capacity_of(values);
  return sum;
}

uint64_t RasterChunk::bytes_of(const ChunkInfo& info, bool textured, bool lit) {
  const uint64_t a_vertex = 3 * sizeof(int32_t) + sizeof(uint8_t) + sizeof(VertexColor) +
                            sizeof(VertexNormal) + (textured ? sizeof(TextureCoordinates) : 0) +
                            (lit ? sizeof(VertexLight) : 0);
  const uint64_t a_triangle = 4 * sizeof(uint32_t) + sizeof(uint8_t);
  const uint64_t spare = 6 * spare_vertices * sizeof(uint32_t) + 2 * sizeof(uint32_t);
  return sizeof(RasterChunk) + info.vertex_count * a_vertex + info.triangle_count * a_triangle + spare +
         (info.triangle_count / block + 1) * sizeof(VertexRange) +
         (info.triangle_count / 32) * sizeof(uint32_t);
}

ChunkGeometry::ChunkGeometry(const Skeleton& skeleton, Residency& residency)
    : skeleton_(skeleton),
      residency_(residency),
      chunks_(skeleton.chunks.size()),
      cache_(skeleton.chunks.size()) {}

void ChunkGeometry::make_room(uint64_t bytes) {
  for (uint32_t old; (old = cache_.next_to_go(bytes)) != ChunkCache::none;) {
    chunks_[old].reset();
    cache_.remove(old);
  }
}

void ChunkGeometry::load(uint32_t chunk) {
  const Stopwatch stopwatch;
  try {
    make_room(RasterChunk::bytes_of(skeleton_.chunks[chunk], !skeleton_.textures.empty(),
                                    has_baked_light(skeleton_.effects)));
  } catch (const NoRoom&) {
    if (missing_.refuse) throw;
    return cache_.leave_out(true);
  }
  const std::optional<Chunk> taken = take(residency_, chunk, missing_, cache_);
  if (!taken) return cache_.leave_out(false);
  auto read = std::make_unique<const RasterChunk>(*taken, skeleton_);
  cache_.add(chunk, read->bytes(), skeleton_.chunks[chunk].size, stopwatch.milliseconds());
  chunks_[chunk] = std::move(read);
}

void ChunkGeometry::require(std::span<const DrawItem> items) {
  if (missing_.wait) {  // all of them are read side by side
    for (const DrawItem& item : items)
      if (!chunks_[item.chunk] && !cache_.is_damaged(item.chunk)) residency_.expect(item.chunk, urgent);
  }
  for (const DrawItem& item : items) require(item.chunk);
}

void ChunkGeometry::require(uint32_t chunk) {
  if (chunks_[chunk]) {
    cache_.touch(chunk);
  } else {
    load(chunk);
  }
}

}  // namespace triptych
