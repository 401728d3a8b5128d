// The triangles of a mesh on a lattice.
#pragma once

#include "model/mesh_stream.hpp"
#include "preprocess/flat_colors.hpp"
#include "scene/affine.hpp"
#include "scene/lattice.hpp"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

namespace triptych {

/// A triangle by its corners on a lattice. The colour is an index into the palette; no_id if the triangle has
/// no area, neither on the lattice nor where it comes from.
struct LatticeTriangle {
  std::array<glm::ivec3, 3> corners;
  uint32_t color;
  CornerColors corner_colors = {};  ///< as they are drawn; unused where the mesh has none
  bool operator==(const LatticeTriangle&) const = default;
};

/// Puts triangles on a lattice: transformed, rounded, with the opposite winding if the transform mirrors.
class ToLattice {
 public:
  /// What `colors` points to must outlive this.
  ToLattice(const Affine& transform, const Lattice& lattice, const MeshColors& colors);
  LatticeTriangle operator()(const CornerTriangle& triangle) const;
  const MeshColors& colors() const { return colors_; }

 private:
  Affine transform_;
  Lattice lattice_;
  MeshColors colors_;
  bool mirrors_;
};

}  // namespace triptych
