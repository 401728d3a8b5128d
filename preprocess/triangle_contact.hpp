// Whether two triangles of a surface meet where they must not, in exact arithmetic.
#pragma once

#include <array>
#include <cstdint>
#include <glm/ext/vector_int3_sized.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace triptych {

/// Coordinates within ±2^29, as on a lattice.
struct ExactTriangle {
  explicit ExactTriangle(const std::array<glm::ivec3, 3>& of_corners);

  std::array<glm::ivec3, 3> corners;
  glm::i64vec3 normal;  ///< twice its area long, to where corners go round counter-clockwise

  bool is_degenerate() const { return normal == glm::i64vec3(0); }
  /// Six times the volume of the tetrahedron between triangle and apex: positive where the apex sees the
  /// back. Rounded; its sign is exact.
  double volume_from(const glm::ivec3& apex) const;
};

/// Six times what a closed surface holds, negative where its triangles go round the other way. Rounded; its
/// sign is exact.
double enclosed_volume(std::span<const ExactTriangle> triangles);

/// Whether two triangles, none of them degenerate, have no point in common but corners, and edges between
/// corners, that both have. Proven by a plane that separates them (Gottschalk, Lin and Manocha, OBBTree,
/// 1996); false where none is found.
bool meet_only_where_shared(const ExactTriangle& a, const ExactTriangle& b);

}  // namespace triptych
