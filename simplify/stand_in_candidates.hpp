// Components of a surface that stand-ins may take the place of (simplify/stand_ins.hpp).
#pragma once

#include "simplify/surface.hpp"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace triptych {

/// What is no further from a plane than this lies in it, lattice steps.
inline constexpr double in_plane_rounding = 2;

/// What a component stands on: the plane of one of its faces, in which all of it lies that is held.
struct StandInBase {
  glm::dvec3 origin, inward;  ///< inward: of length 1
};

/// A component, and what is known of its points and triangles.
struct StandInComponent {
  Piece piece;
  std::vector<uint8_t> locked;  ///< for each point
  std::optional<StandInBase> base;
  bool is_inside_out = false;  ///< its triangles go round clockwise where they are seen from outside
};

/// A component of one colour that is neither too small nor too large.
struct StandInCandidate {
  StandInComponent component;
  std::vector<uint32_t> triangles;
  size_t like = 0;         ///< the first one that is this one moved, or this one
  bool is_convex = false;  ///< and closed; what is held lies in the plane of one face
};

/// In the order of their first triangles. locked: for each point; empty: none. None where corners have
/// colours, nor where convex ones have fewer triangles altogether than `least`.
std::vector<StandInCandidate> stand_in_candidates(const Surface& surface, std::span<const uint8_t> locked,
                                                  size_t least);

}  // namespace triptych
