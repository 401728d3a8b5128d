#include "raster/chunk_geometry.hpp"

#include <algorithm>
#include <limits>

namespace triptych {

namespace {

constexpr uint32_t block = 64;  ///< triangles

template <typename Value>
uint64_t bytes_of(const std::vector<Value>& values) {
  return values.capacity() * sizeof(Value);
}

}  // namespace

RasterChunk::RasterChunk(const Chunk& chunk) : vertex_color(chunk.colors) {
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
  uint64_t sum = sizeof *this + bytes_of(x) + bytes_of(y) + bytes_of(z) + bytes_of(piece) + bytes_of(color) +
                 bytes_of(outward) + bytes_of(ranges_) + bytes_of(layers) + bytes_of(vertex_color);
  for (const auto& values : corner) sum += bytes_of(values);
  return sum;
}

ChunkGeometry::ChunkGeometry(const Skeleton& skeleton, Residency& residency)
    : residency_(residency), chunks_(skeleton.chunks.size()) {}

void ChunkGeometry::require(std::span<const DrawItem> items) {
  for (const DrawItem& item : items) require(item.chunk);
}

void ChunkGeometry::require(uint32_t index) {
  if (chunks_[index]) return;
  residency_.request(index, 0);
  residency_.pump(std::numeric_limits<double>::infinity());
  auto chunk = std::make_unique<const RasterChunk>(*residency_.pin(index));
  residency_.unpin(index);
  residency_.evict(index);  // it has its place here now
  bytes_ += chunk->bytes();
  chunks_[index] = std::move(chunk);
}

}  // namespace triptych
