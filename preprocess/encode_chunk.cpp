#include "preprocess/encode_chunk.hpp"

#include "base/bytes.hpp"
#include "preprocess/outward.hpp"
#include "preprocess/write_packed.hpp"

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

struct SortedTriangles {
  std::vector<uint32_t> indices;
  std::vector<uint32_t> run_ends;  ///< of those that keep their places
  bool is_seen_through = false;
};

/// The chunk's triangles, in each run the opaque ones before those that are cut out, and these before the
/// transparent ones.
SortedTriangles sort_triangles(const Chunk& chunk, std::span<const uint32_t> runs, Palette palette) {
  SortedTriangles sorted{{}, {runs.begin(), runs.end()}, false};
  const bool has_holes = !palette.empty() && !cut_out_runs(chunk, palette).empty();
  if (!has_holes && (palette.empty() || transparent_runs(chunk, palette).empty())) {
    sorted.indices = chunk.indices;
    return sorted;
  }
  sorted.is_seen_through = true;
  sorted.run_ends.clear();
  enum class Kind : uint8_t { solid, cut_out, transparent };
  const auto kind_of = [&](size_t triangle) {
    const uint32_t color = palette_index(chunk, triangle);
    if (is_transparent(palette[color])) return Kind::transparent;
    return is_cut_out(palette, color) ? Kind::cut_out : Kind::solid;
  };
  const auto add = [&](size_t first, size_t end, Kind kind) {
    for (size_t i = first; i < end; ++i) {
      if (kind_of(i) != kind) continue;
      sorted.indices.insert(sorted.indices.end(), chunk.indices.data() + 3 * i,
                            chunk.indices.data() + 3 * (i + 1));
    }
    sorted.run_ends.push_back(static_cast<uint32_t>(sorted.indices.size() / 3));
  };
  size_t first = 0;
  const auto add_run = [&](size_t end) {
    add(first, end, Kind::solid);
    if (has_holes) add(first, end, Kind::cut_out);
    add(first, end, Kind::transparent);
    first = end;
  };
  for (const uint32_t end : runs) add_run(end);
  add_run(chunk.triangle_count());
  return sorted;
}

/// Values of vertices in their new places; none where there are none.
template <typename Value>
std::vector<Value> moved(const std::vector<Value>& values, const std::vector<uint32_t>& places,
                         size_t count) {
  std::vector<Value> result(values.empty() ? 0 : count);
  for (size_t i = 0; i < values.size(); ++i) {
    if (places[i] < count) result[places[i]] = values[i];
  }
  return result;
}

}  // namespace

std::vector<std::byte> encode_chunk(const Chunk& chunk, std::span<const uint32_t> runs_kept,
                                    Palette palette) {
  const SortedTriangles sorted = sort_triangles(chunk, runs_kept, palette);
  // Vertex cache order, then vertices in the order of their first use: both codecs compress better so.
  std::vector<uint32_t> indices(chunk.indices.size());
  const auto reorder = [&](size_t first, size_t end) {
    if (first == end) return;
    meshopt_optimizeVertexCacheFifo(indices.data() + 3 * first, sorted.indices.data() + 3 * first,
                                    3 * (end - first), chunk.vertices.size(), cache_size);
  };
  size_t first = 0;
  for (const uint32_t end : sorted.run_ends) {
    reorder(first, end);
    first = end;
  }
  reorder(first, chunk.triangle_count());
  std::vector<uint32_t> places(chunk.vertices.size());
  const size_t vertex_count =
      meshopt_optimizeVertexFetchRemap(places.data(), indices.data(), indices.size(), chunk.vertices.size());
  meshopt_remapIndexBuffer(indices.data(), indices.data(), indices.size(), places.data());
  const std::vector<ChunkVertex> vertices = moved(chunk.vertices, places, vertex_count);
  const std::vector<VertexColor> colors = moved(chunk.colors, places, vertex_count);
  const std::vector<TextureCoordinates> coordinates = moved(chunk.coordinates, places, vertex_count);
  const std::vector<VertexNormal> normals = moved(chunk.normals, places, vertex_count);
  const std::vector<VertexLight> light = moved(chunk.light, places, vertex_count);
  std::vector<uint8_t> index_bytes(meshopt_encodeIndexBufferBound(indices.size(), vertices.size()));
  index_bytes.resize(
      meshopt_encodeIndexBuffer(index_bytes.data(), index_bytes.size(), indices.data(), indices.size()));
  std::vector<glm::ivec3> points;
  for (const ChunkVertex& vertex : vertices) points.push_back(vertex.point);
  std::vector<bool> seen_through;
  if (sorted.is_seen_through) {
    for (size_t i = 2; i < indices.size(); i += 3)
      seen_through.push_back(is_seen_through(palette, vertices[indices[i]].color));
  }
  const std::vector<uint32_t> runs = runs_of(outward_triangles(points, indices, seen_through));
  ByteWriter writer;
  writer.write(static_cast<uint32_t>(vertices.size()));
  writer.write(static_cast<uint32_t>(indices.size() / 3));
  writer.write(static_cast<uint32_t>(runs.size()));
  writer.write_all(std::span<const uint32_t>(runs));
  write_packed(vertices, writer);
  if (!colors.empty()) {
    writer.write(chunk_colors_stream);
    write_packed(colors, writer);
  }
  if (!coordinates.empty()) {
    writer.write(chunk_coordinates_stream);
    write_packed(coordinates, writer);
  }
  if (!normals.empty()) {
    writer.write(chunk.normals_from == ChunkNormals::of_files ? chunk_file_normals_stream
                                                              : chunk_level_normals_stream);
    write_packed(normals, writer);
  }
  if (!light.empty()) {
    writer.write(chunk_light_stream);
    write_packed(light, writer);
  }
  writer.write_all(std::span<const uint8_t>(index_bytes));
  return std::move(writer.bytes());
}

}  // namespace triptych
