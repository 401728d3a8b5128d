// Shapes of a few triangles that stand in for small convex things: bolts, rods, balls, boxes. They cover as
// much of the screen, from all directions on average, and are nearer to them than what collapses leave.
#pragma once

#include "simplify/surface.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// A shape in place of a component.
struct StandIn {
  Piece piece;       ///< sources: indices into the points of the surface that the component is of
  double bound = 0;  ///< of the two-sided distance to the component, lattice steps
};

/// A component that has them.
struct ConvexComponent {
  std::vector<uint32_t> triangles;  ///< of the surface, ascending
  std::vector<StandIn> stand_ins;   ///< with fewer and fewer triangles, and larger and larger bounds
};

/// The components of a surface that are closed, convex but for rounding and of one colour, that have at least
/// 8 and at most 512 triangles, and of which all that is held lies in the plane of one face, on which they
/// stand: locked points, and triangles that lie in layers or are covered. In the order of their first
/// triangles. Stand-ins are four-sided prisms and antiprisms, on the component's plane if it stands on one,
/// with 92 % of its area (which decides how much something convex covers: Cauchy), and of rods that stand on
/// nothing three-sided prisms and tetrahedra, with all of it; along the component's axes, where they are
/// nearer than `max_bound` and have fewer triangles. locked: for each point; empty: none. Nothing where
/// corners have colours, nor where such components have fewer triangles altogether than `least`: then no
/// stand-in is made.
std::vector<ConvexComponent> convex_components(const Surface& surface, std::span<const uint8_t> locked,
                                               double max_bound, size_t least = 0);

}  // namespace triptych
