// A chain of ever coarser surfaces, each with a proven bound of its distance to the first.
#pragma once

#include "lod/distance.hpp"
#include "scene/surface.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

struct SimplifyLimits {
  size_t triangles = 32;         ///< the chain ends when a level has no more than this
  double largest_bound = 1e300;  ///< and before a level whose bound is larger; lattice steps
  Colors colors = Colors::keep;  ///< what the bounds hold for
};

struct Level {
  Piece piece;  ///< sources: indices into the points of the surface that the chain began with
  double bound =
      0;  ///< of the two-sided distance to that surface, lattice steps; never shrinks along the chain
};

struct Chain {
  std::vector<Level>
      levels;  ///< finest first, each with at most three quarters of the one before; the input is none
  size_t detached_triangles = 0;  ///< of the input: meet the others in a way that half-edges cannot express
  bool stuck = false;             ///< ended above `triangles` because nothing made it coarser
};

/// Each level has about half of the triangles of the one before it, by edge collapses, or by vertex
/// clustering where collapses get stuck or would be further off. Locked points stay in every level.
Chain simplify(const Surface& surface, std::span<const uint8_t> locked, const SimplifyLimits& limits);

}  // namespace triptych
