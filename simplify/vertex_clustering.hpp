// Simplification of anything: points that share a cell of a grid become one of them (after Rossignac and
// Borrel, Multi-resolution 3D approximations for rendering complex scenes, 1993). Merges what is disjoint and
// loses nothing.
#pragma once

#include "simplify/distance.hpp"
#include "simplify/layered_planes.hpp"
#include "simplify/surface.hpp"

#include <cstdint>
#include <span>

namespace triptych {

struct Clustered {
  Piece piece;       ///< sources: indices into the points of the surface
  double bound = 0;  ///< of the two-sided distance to the surface by construction, lattice steps
  /// The size of the largest layered plane that a point has left, lattice steps; the bound is no smaller.
  double planes_left = 0;
};

/// Each point moves to the point of its cell that fits the planes around best; locked points stay. A triangle
/// that collapses to a line or a point is removed; where no remaining triangle contains that line or point, a
/// thin triangle between points of the surface replaces it. So every point of the surface stays within
/// `bound` of the result, and vice versa; of its own colour, where colours are kept, and where it has a
/// layer. Points stay in layered planes that are larger than two cells.
Clustered cluster_vertices(const Surface& surface, std::span<const uint8_t> locked, double cell,
                           Colors colors, const LayeredPlanes& layered = LayeredPlanes::none());

/// Whether the result of the same has at most `triangles`; cheaper.
bool clusters_within(const Surface& surface, std::span<const uint8_t> locked, double cell, size_t triangles,
                     Colors colors, const LayeredPlanes& layered = LayeredPlanes::none());

/// The result of the finest cells that has at most `triangles`, or the coarsest one possible.
Clustered cluster_to(const Surface& surface, std::span<const uint8_t> locked, size_t triangles, Colors colors,
                     const LayeredPlanes& layered = LayeredPlanes::none());

}  // namespace triptych
