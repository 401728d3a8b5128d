// Triangles on a lattice: what welding, partition and simplification pass to each other.
#pragma once

#include "base/disjoint_sets.hpp"
#include "model/model.hpp"
#include "scene/box.hpp"
#include "scene/transparency.hpp"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace triptych {

/// What Triangle::material holds in a Surface: in its lowest 20 bits an index into the palette, above them
/// ChunkVertex::layer, and from bit 24 on the class of a covered triangle (preprocess/covered/), or 0.
/// Where any of them changes, simplifiers see a border.
inline uint32_t palette_index(uint32_t material) { return material & (max_colors - 1); }
inline uint32_t layer_of(uint32_t material) { return material >> 20 & max_layer; }
inline uint32_t covered_class(uint32_t material) { return material >> 24; }
inline uint32_t material_in_layer(uint32_t material, uint32_t layer) { return material | layer << 20; }
inline uint32_t material_seen(uint32_t material) { return material & 0xffffffu; }
inline uint32_t material_covered(uint32_t material, uint32_t of_class) { return material | of_class << 24; }

/// What a corner of a triangle has besides its point.
struct SurfaceCorner {
  SurfaceCorner() = default;
  SurfaceCorner(const VertexColor& own_color, const TextureCoordinates& place = {})
      : color(own_color), coordinates(place) {}
  SurfaceCorner(const VertexColor& own_color, const TextureCoordinates& place, const VertexLight& own_light)
      : color(own_color), coordinates(place), light(own_light) {}
  VertexColor color = {};               ///< as it is drawn; none where it is the material's
  TextureCoordinates coordinates = {};  ///< none where its material has no texture
  VertexLight light = {};               ///< none where no light was baked
  bool operator==(const SurfaceCorner&) const = default;
};

struct SurfaceCorners : std::array<SurfaceCorner, 3> {
  SurfaceCorners() = default;
  SurfaceCorners(const CornerColors& colors, const CornerCoordinates& coordinates = {},
                 const CornerLight& light = {}) {
    for (size_t k = 0; k < 3; ++k) (*this)[k] = {colors[k], coordinates[k], light[k]};
  }
};

/// Different points of a lattice, and triangles that share them. No triangle is degenerate, and every point
/// belongs to one.
struct Surface {
  std::vector<glm::ivec3> points;
  std::vector<Triangle> triangles;
  /// What colours the corners of each triangle; empty if the materials alone do. Corners at one point may
  /// differ: a seam runs there.
  std::vector<SurfaceCorners> colors = {};
  /// The shading normals of the corners of each triangle; none where it shows its own. Empty if the surface
  /// has none.
  std::vector<CornerNormals> normals = {};
  bool file_normals = false;  ///< they come from the model's files

  LatticeBox box() const;
  /// Where all triangles show their own normals, the surface has none.
  void drop_empty_normals();
};

/// A piece of a surface, and the index of each of its points in the whole.
struct Piece {
  Surface surface;
  std::vector<uint32_t> sources;  ///< for each point of the piece its index in the whole
};

/// The given triangles of the surface as a piece of its own, points in the order of their first use. colors:
/// of the triangles, or empty.
Piece extract(const std::vector<glm::ivec3>& points, std::span<const Triangle> triangles,
              std::span<const SurfaceCorners> colors = {});
/// Of its triangles those of these numbers, with all that their corners have.
Piece extract(const Surface& surface, std::span<const uint32_t> chosen);
/// All of them: without points that no triangle has.
Piece without_lone_points(const Surface& surface);

/// Whether backs are seen through any of its triangles.
bool is_seen_through(const Surface& surface, Palette palette);

/// The surface's points in the sets that its triangles connect.
DisjointSets connected_points(const Surface& surface);

/// The surface as it is drawn: a vertex for each point, colour (of palette and corner), place on a texture,
/// normal, baked light and piece that meet. `pieces`: for each triangle ChunkVertex::piece; empty if all of
/// it is one piece.
Chunk make_chunk(const Surface& surface, std::span<const uint8_t> pieces = {});

/// True if the corners lie on one line; exact.
bool degenerate(const glm::ivec3& a, const glm::ivec3& b, const glm::ivec3& c);
/// The corners of a degenerate triangle, two of them moved by at most a step each so that it has an area.
std::array<glm::ivec3, 3> with_area(const std::array<glm::ivec3, 3>& corners);

}  // namespace triptych
