#include "raster/chunk_geometry.hpp"

#include <limits>

namespace triptych {

namespace {

RasterChunk convert(const Chunk& chunk) {
  RasterChunk result;
  for (const ChunkVertex& vertex : chunk.vertices) {
    result.x.push_back(vertex.point.x);
    result.y.push_back(vertex.point.y);
    result.z.push_back(vertex.point.z);
    result.piece.push_back(static_cast<uint8_t>(vertex.piece));
  }
  result.corners = chunk.indices;
  // Colours are of triangles: as in OpenGL, the last corner's.
  for (size_t i = 2; i < chunk.indices.size(); i += 3)
    result.color.push_back(chunk.vertices[chunk.indices[i]].color);
  return result;
}

template <typename Value>
uint64_t bytes_of(const std::vector<Value>& values) {
  return values.capacity() * sizeof(Value);
}

}  // namespace

uint64_t RasterChunk::bytes() const {
  return sizeof *this + bytes_of(x) + bytes_of(y) + bytes_of(z) + bytes_of(piece) + bytes_of(corners) +
         bytes_of(color);
}

ChunkGeometry::ChunkGeometry(const Skeleton& skeleton, Residency& residency)
    : residency_(residency), chunks_(skeleton.chunks.size()) {}

void ChunkGeometry::require(std::span<const DrawItem> items) {
  for (const DrawItem& item : items) {
    if (chunks_[item.chunk]) continue;
    residency_.request(item.chunk, 0);
    residency_.pump(std::numeric_limits<double>::infinity());
    auto chunk = std::make_unique<const RasterChunk>(convert(*residency_.pin(item.chunk)));
    residency_.unpin(item.chunk);
    residency_.evict(item.chunk);  // it has its place here now
    bytes_ += chunk->bytes();
    chunks_[item.chunk] = std::move(chunk);
  }
}

}  // namespace triptych
