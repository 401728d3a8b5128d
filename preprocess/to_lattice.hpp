// The triangles of a mesh on a lattice.
#pragma once

#include "model/mesh_stream.hpp"
#include "preprocess/vertex_tint.hpp"
#include "scene/affine.hpp"
#include "scene/lattice.hpp"
#include "scene/surface_material.hpp"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

namespace triptych {

/// A triangle by its corners on a lattice. The colour is an index into the palette; no_id if the triangle has
/// no area, neither on the lattice nor where it comes from.
struct LatticeTriangle {
  std::array<glm::ivec3, 3> corners;
  uint32_t color;
  CornerColors corner_colors = {};     ///< as they are drawn; unused where the mesh has none
  CornerCoordinates coordinates = {};  ///< none where the colour has no texture
  bool operator==(const LatticeTriangle&) const = default;
};

/// Puts triangles on a lattice: transformed, rounded, with the opposite winding if the transform mirrors.
class ToLattice {
 public:
  /// `colors` gives the palette index of each material, `tint` what vertex colours become, if there are any.
  /// materials: of the palette (Skeleton::materials). All must outlive this.
  ToLattice(const Affine& transform, const Lattice& lattice, std::span<const uint32_t> colors,
            const VertexTint* tint = nullptr, std::span<const SurfaceMaterial> materials = {});
  LatticeTriangle operator()(const CornerTriangle& triangle) const;

 private:
  Affine transform_;
  Lattice lattice_;
  std::span<const uint32_t> colors_;
  const VertexTint* tint_;
  std::span<const SurfaceMaterial> materials_;
  bool mirrors_;
};

}  // namespace triptych
