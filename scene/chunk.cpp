#include "scene/chunk.hpp"

#include "base/bytes.hpp"

#include <meshoptimizer.h>

namespace triptych {

std::vector<bool> Chunk::outward() const {
  std::vector<bool> result;
  bool current = false;
  for (const uint32_t end : outward_runs) {
    result.resize(end, current);
    current = !current;
  }
  result.resize(triangle_count());
  return result;
}

LatticeBox Chunk::box() const {
  LatticeBox box;
  for (const ChunkVertex& vertex : vertices) box.extend(vertex.point);
  return box;
}

std::vector<LatticeBox> Chunk::pieces() const {
  std::vector<LatticeBox> boxes;
  for (const ChunkVertex& vertex : vertices) {
    if (vertex.piece >= boxes.size()) boxes.resize(vertex.piece + 1u);
    boxes[vertex.piece].extend(vertex.point);
  }
  if (boxes.size() == 1) boxes.clear();
  return boxes;
}

namespace {

/// A size, and so many bytes that hold `count` values.
template <typename Value>
std::vector<Value> read_vertex_stream(ByteReader& reader, size_t count, const std::string& place) {
  const auto bytes = reader.read_all<uint8_t>(reader.read<uint32_t>());
  std::vector<Value> values(count);
  if (meshopt_decodeVertexBuffer(values.data(), count, sizeof(Value), bytes.data(), bytes.size()) != 0)
    fail(place, "does not decode");
  return values;
}

}  // namespace

Chunk decode_chunk(std::span<const std::byte> bytes, const ChunkInfo& info,
                   std::span<const LatticeBox> pieces, size_t palette_size, const std::string& place) {
  ByteReader reader(bytes, place);
  const auto vertex_count = reader.read<uint32_t>();
  const auto triangle_count = reader.read<uint32_t>();
  if (vertex_count != info.vertex_count || triangle_count != info.triangle_count) {
    fail(place, "holds {} vertices and {} triangles instead of {} and {}", vertex_count, triangle_count,
         info.vertex_count, info.triangle_count);
  }
  auto outward_runs = reader.read_all<uint32_t>(reader.read<uint32_t>());
  for (size_t i = 0; i < outward_runs.size(); ++i) {  // the first one may be empty
    if (outward_runs[i] > triangle_count || (i > 0 && outward_runs[i] <= outward_runs[i - 1]))
      fail(place, "has a run of triangles that ends at {} of {}", outward_runs[i], triangle_count);
  }
  Chunk chunk{.vertices = read_vertex_stream<ChunkVertex>(reader, vertex_count, place),
              .indices = {},
              .outward_runs = std::move(outward_runs)};
  auto rest = reader.read_all<uint8_t>(reader.left());
  uint8_t before = 0;
  while (!rest.empty() && rest.front() < first_index_byte) {
    const uint8_t kind = rest.front();
    if (kind <= before) fail(place, "has a stream of the kind {} behind one of the kind {}", kind, before);
    ByteReader attributes(std::as_bytes(std::span(rest).subspan(1)), place);
    if (kind == chunk_colors_stream) {
      chunk.colors = read_vertex_stream<VertexColor>(attributes, vertex_count, place);
    } else if (kind == chunk_coordinates_stream) {
      chunk.coordinates = read_vertex_stream<TextureCoordinates>(attributes, vertex_count, place);
    } else if (kind == chunk_level_normals_stream || kind == chunk_file_normals_stream) {
      if (!chunk.normals.empty()) fail(place, "has two streams of normals");
      chunk.normals = read_vertex_stream<VertexNormal>(attributes, vertex_count, place);
      chunk.normals_from =
          kind == chunk_file_normals_stream ? ChunkNormals::of_files : ChunkNormals::of_levels;
    } else if (kind == chunk_light_stream) {
      chunk.light = read_vertex_stream<VertexLight>(attributes, vertex_count, place);
    } else {
      fail(place, "has a stream of the unknown kind {}", kind);
    }
    rest = attributes.read_all<uint8_t>(attributes.left());
    before = kind;
  }
  chunk.indices.resize(size_t{triangle_count} * 3);
  if (meshopt_decodeIndexBuffer(chunk.indices.data(), chunk.indices.size(), rest.data(), rest.size()) != 0)
    fail(place, "does not decode");
  for (const uint32_t index : chunk.indices) {
    if (index >= vertex_count) fail(place, "names vertex {} of {}", index, vertex_count);
  }
  for (const ChunkVertex& vertex : chunk.vertices) {
    if (vertex.color >= palette_size) fail(place, "names colour {} of {}", +vertex.color, palette_size);
    if (vertex.piece >= pieces.size()) fail(place, "names piece {} of {}", +vertex.piece, pieces.size());
    if (!pieces[vertex.piece].contains(LatticeBox{vertex.point, vertex.point}))
      fail(place, "has a vertex outside its box");
  }
  for (const VertexNormal& normal : chunk.normals) {
    if (has_normal(normal) ? !is_vertex_normal(normal) : normal[1] != 0)
      fail(place, "has a normal {}, {}, which is none", normal[0], normal[1]);
  }
  for (size_t i = 0; i < chunk.indices.size(); i += 3) {
    const auto shaded = [&](size_t k) {
      return !chunk.normals.empty() && has_normal(chunk.normals[chunk.indices[i + k]]);
    };
    if (shaded(0) != shaded(1) || shaded(0) != shaded(2))
      fail(place, "has a triangle with normals at some of its corners");
    const uint32_t piece = chunk.vertices[chunk.indices[i]].piece;
    for (size_t k = 1; k < 3; ++k) {
      if (chunk.vertices[chunk.indices[i + k]].piece != piece)
        fail(place, "has a triangle across its pieces");
    }
  }
  return chunk;
}

}  // namespace triptych
