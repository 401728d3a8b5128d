// The triangles of a mesh on a lattice.
#pragma once

#include "model/model.hpp"
#include "preprocess/flat_colors.hpp"
#include "scene/affine.hpp"
#include "scene/lattice.hpp"

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace triptych {

/// A triangle by its corners on a lattice. The colour is an index into the palette; no_id if the triangle has
/// no area, neither on the lattice nor where it comes from.
struct LatticeTriangle {
  std::array<glm::ivec3, 3> corners;
  uint32_t color;
  CornerColors corner_colors = {};     ///< as they are drawn; unused where the mesh has none
  CornerNormals corner_normals = {};   ///< on the lattice; all of the corners' or none
  CornerCoordinates coordinates = {};  ///< none where the colour has no texture
  CornerLight light = {};              ///< baked; unused where the mesh has none
  bool operator==(const LatticeTriangle&) const = default;
};

/// What corners have, which need not be kept where they have none.
struct CornerStreams {
  bool colors = false, normals = false, coordinates = false, light = false;
};
inline CornerStreams corner_streams(const Mesh& mesh, const MeshColors& colors) {
  return {colors.of_corners(), mesh.has_normals(), mesh.has_coordinates() && !colors.surfaces.empty(),
          !mesh.light.empty()};
}

/// What takes normals along under a transform: its cofactors, so that they keep looking to the same side of
/// the surface where it mirrors, too.
glm::dmat3 normal_matrix(const glm::dmat3& linear);
/// All of the corners' normals, or none.
CornerNormals placed_normals(const CornerNormals& normals, const glm::dmat3& normal_matrix);

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
  glm::dmat3 of_normals_;  ///< mesh to lattice
};

}  // namespace triptych
