// A chunk of geometry, as it is drawn: lattice points with a colour, and triangles.
#pragma once

#include "scene/layers.hpp"
#include "scene/skeleton.hpp"
#include "scene/vertex_color.hpp"
#include "scene/vertex_light.hpp"
#include "scene/vertex_normal.hpp"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// 16 bytes, as the graphics card reads it.
struct ChunkVertex {
  glm::ivec3 point;         ///< on the chunk's lattice
  uint32_t color : 20 = 0;  ///< index into the palette
  uint32_t layer : 4 = 0;   ///< of the triangles that it belongs to (scene/layers.hpp)
  uint32_t piece : 8 = 0;   ///< index into the chunk's pieces; the same for all corners of a triangle
  bool operator==(const ChunkVertex&) const = default;
};
static_assert(sizeof(ChunkVertex) == 16);

/// The most colours of a palette: vertices could not name more.
inline constexpr size_t max_colors = size_t{1} << 20;
/// The most pieces of a chunk, for the same reason.
inline constexpr size_t max_chunk_pieces = 256;

/// Where a chunk's shading normals come from, if it has any: coarse levels of faceted surfaces have those of
/// the surface that they stand for; or the model's files have them.
enum class ChunkNormals : uint8_t { none, of_levels, of_files };

/// The bytes that begin a chunk's streams of attributes (vertex colours, texture coordinates, normals, baked
/// light), which come in this order. That of indices begins with 0xe0 or more.
inline constexpr uint8_t chunk_colors_stream = 1, chunk_coordinates_stream = 2,
                         chunk_level_normals_stream = 3, chunk_file_normals_stream = 4,
                         chunk_light_stream = 5, first_index_byte = 0xe0;

struct Chunk {
  std::vector<ChunkVertex> vertices;
  std::vector<uint32_t> indices;  ///< three per triangle, counter-clockwise from outside
  /// Where runs of triangles end: of those that are not known to be outward, of those that are, and so on in
  /// turn; those after the last run are not. Outward ones belong to a closed surface whose backs nobody
  /// outside of it sees (preprocess/outward.hpp).
  std::vector<uint32_t> outward_runs = {};
  /// Of each vertex, shown in place of the palette's and interpolated over triangles; empty if the chunk has
  /// none.
  std::vector<VertexColor> colors = {};
  /// Of each vertex, interpolated over triangles for their shade; the corners of a triangle all have one, or
  /// none. Empty if no vertex has one.
  std::vector<VertexNormal> normals = {};
  ChunkNormals normals_from = ChunkNormals::none;
  /// Of each vertex, on the texture of its colour (SurfaceMaterial::texture); empty if the chunk has none.
  std::vector<TextureCoordinates> coordinates = {};
  /// Of each vertex, interpolated over triangles; empty if the chunk has none.
  std::vector<VertexLight> light = {};

  size_t triangle_count() const { return indices.size() / 3; }
  /// The runs, triangle by triangle.
  std::vector<bool> outward() const;
  LatticeBox box() const;
  /// The boxes of the pieces, if there are several; empty if there is only one.
  std::vector<LatticeBox> pieces() const;
};

/// Reads back what encode_chunk (preprocess/encode_chunk.hpp) wrote. Error (place) for bytes that do not
/// decode, or that hold other counts than `info`, indices out of range, colours beyond palette_size, normals
/// that are none or of some corners of a triangle alone, points outside their piece's box, or triangles
/// across pieces. `pieces`: Skeleton::pieces_of() the chunk.
Chunk decode_chunk(std::span<const std::byte> bytes, const ChunkInfo& info,
                   std::span<const LatticeBox> pieces, size_t palette_size, const std::string& place);

}  // namespace triptych
