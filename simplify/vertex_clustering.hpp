// Simplification of anything: points that share a cell of a grid become one of them (after Rossignac and
// Borrel, Multi-resolution 3D approximations for rendering complex scenes, 1993). Merges what is disjoint and
// loses nothing.
#pragma once

#include "simplify/distance.hpp"
#include "simplify/surface.hpp"

#include <cstdint>
#include <span>

namespace triptych {

struct Clustered {
  Piece piece;       ///< sources: indices into the points of the surface
  double bound = 0;  ///< of the two-sided distance to the surface by construction, lattice steps
};

/// Each point moves to the point of its cell that fits the planes around best; locked points stay. A triangle
/// whose corners then are fewer than three goes, and where nothing that is left holds its image, a line or a
/// point, a thin triangle between points of the surface stays in its place: so every point of the surface
/// stays within `bound` of the result, and the other way round; of its own colour, where colours are kept.
Clustered cluster_vertices(const Surface& surface, std::span<const uint8_t> locked, double cell,
                           Colors colors);

/// Whether the same has at most so many triangles; cheaper.
bool clusters_within(const Surface& surface, std::span<const uint8_t> locked, double cell, size_t triangles,
                     Colors colors);

/// The result with the finest cells that has at most so many triangles, or the coarsest one there is.
Clustered cluster_to(const Surface& surface, std::span<const uint8_t> locked, size_t triangles,
                     Colors colors);

}  // namespace triptych
