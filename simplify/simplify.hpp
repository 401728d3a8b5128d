// A chain of successively coarser surfaces, each with a proven bound of its distance to the first.
#pragma once

#include "simplify/distance.hpp"
#include "simplify/surface.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// What removes triangles. Where it gets stuck, vertices are clustered.
enum class Simplifier : uint8_t {
  collapse,  ///< edge collapses of our own, bounded one by one; any mesh
  openmesh,  ///< OpenMesh's decimater; what half-edges cannot express is kept separately
  meshopt,   ///< meshoptimizer's simplifier; single precision, non-manifold points stay
};

/// Where bounds come from.
enum class Bound : uint8_t {
  /// From the construction; for simplifiers without one, measured quickly from level to level, and added up.
  fast,
  /// Measured against the source, and never above the fast one; the fast one where corners have colours.
  tight,
};

struct SimplifyLimits {
  /// The chain ends when a level has no more than this plus two for each locked point: one for each would be
  /// possible, but going below two increases the error many times, also of everything that is made from the
  /// result.
  size_t triangles = 32;
  double max_bound = 1e300;      ///< the chain also ends before a level whose bound is larger; lattice steps
  Colors colors = Colors::keep;  ///< what the bounds hold for
  Simplifier simplifier = Simplifier::collapse;
  Bound bound = Bound::fast;
  /// Whether components are enlarged where they would cover less than in the input (simplify/cover.hpp);
  /// points of such levels are not points of the input.
  bool keep_cover = false;
};

struct Level {
  /// sources: indices into the points of the surface that the chain began with; the points are these, unless
  /// SimplifyLimits::keep_cover moved them.
  Piece piece;
  /// Of the two-sided distance to that surface, lattice steps; never shrinks along the chain.
  double bound = 0;
  double moved = 0;        ///< how far keep_cover moved a point at most, lattice steps
  double planes_left = 0;  ///< the size of the largest layered plane that a point has left, lattice steps
};

struct Chain {
  /// Finest first, each with at most three quarters of the one before; the input is none.
  std::vector<Level> levels;
  /// Triangles of the input that meet others in a way that half-edges cannot express.
  size_t detached_triangles = 0;
  bool stuck = false;  ///< ended early because nothing made it coarser
};

/// Each level has about half of the triangles of the one before it, by the simplifier, or by vertex
/// clustering where that gets stuck or would be further from the source. Points of triangles that have layers
/// stay in their planes (simplify/layered_planes.hpp) in levels whose bound is less than what lies there is
/// large. Locked points stay in every level,
/// and no connected component vanishes, except by clustering, which leaves something near in its place.
Chain simplify(const Surface& surface, std::span<const uint8_t> locked, const SimplifyLimits& limits);

}  // namespace triptych
