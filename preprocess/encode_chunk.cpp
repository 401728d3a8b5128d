#include "preprocess/encode_chunk.hpp"

#include "base/bytes.hpp"
#include "preprocess/outward.hpp"

#include <meshoptimizer.h>

namespace triptych {

namespace {

/// In vertices. Graphics cards hold more or fewer; what matters is that recently used indices come again.
constexpr unsigned cache_size = 16;

/// Chunk::outward_runs.
std::vector<uint32_t> runs_of(const std::vector<bool>& outward) {
  std::vector<uint32_t> ends;
  bool current = false;
  for (uint32_t i = 0; i < outward.size(); ++i) {
    if (outward[i] == current) continue;
    ends.push_back(i);
    current = outward[i];
  }
  if (current) ends.push_back(static_cast<uint32_t>(outward.size()));
  return ends;
}

}  // namespace

std::vector<std::byte> encode_chunk(const Chunk& chunk) {
  // Vertex cache order, then vertices in the order of their first use: both codecs compress better so.
  std::vector<uint32_t> indices(chunk.indices.size());
  meshopt_optimizeVertexCacheFifo(indices.data(), chunk.indices.data(), indices.size(), chunk.vertices.size(),
                                  cache_size);
  std::vector<ChunkVertex> vertices(chunk.vertices.size());
  vertices.resize(meshopt_optimizeVertexFetch(vertices.data(), indices.data(), indices.size(),
                                              chunk.vertices.data(), chunk.vertices.size(),
                                              sizeof(ChunkVertex)));
  std::vector<uint8_t> index_bytes(meshopt_encodeIndexBufferBound(indices.size(), vertices.size()));
  index_bytes.resize(
      meshopt_encodeIndexBuffer(index_bytes.data(), index_bytes.size(), indices.data(), indices.size()));
  std::vector<uint8_t> vertex_bytes(meshopt_encodeVertexBufferBound(vertices.size(), sizeof(ChunkVertex)));
  vertex_bytes.resize(meshopt_encodeVertexBuffer(vertex_bytes.data(), vertex_bytes.size(), vertices.data(),
                                                 vertices.size(), sizeof(ChunkVertex)));
  std::vector<glm::ivec3> points;
  for (const ChunkVertex& vertex : vertices) points.push_back(vertex.point);
  const std::vector<uint32_t> runs = runs_of(outward_triangles(points, indices));
  ByteWriter writer;
  writer.write(static_cast<uint32_t>(vertices.size()));
  writer.write(static_cast<uint32_t>(indices.size() / 3));
  writer.write(static_cast<uint32_t>(runs.size()));
  writer.write_all(std::span<const uint32_t>(runs));
  writer.write(static_cast<uint32_t>(vertex_bytes.size()));
  writer.write_all(std::span<const uint8_t>(vertex_bytes));
  writer.write_all(std::span<const uint8_t>(index_bytes));
  return std::move(writer.bytes());
}

}  // namespace triptych
