// A chain of ever coarser surfaces, each with a proven bound of its distance to the first.
#pragma once

#include "simplify/distance.hpp"
#include "simplify/surface.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// Who takes triangles away. Where none of them gets further, vertices are clustered.
enum class Simplifier : uint8_t {
  collapse,  ///< edge collapses of our own, bounded one by one; any mesh
  openmesh,  ///< OpenMesh's decimater; what half-edges cannot express stands beside
  meshopt,   ///< meshoptimizer's simplifier; single precision, non-manifold points stay
};

/// Where bounds come from.
enum class Bound : uint8_t {
  /// From the construction; for simplifiers that have none, from level to level, measured in a hurry, and
  /// added up.
  fast,
  /// Measured against the source, and never above the fast one.
  tight,
};

struct SimplifyLimits {
  /// The chain ends when a level has no more than this, and two for each locked point: a surface could do
  /// with one, but what goes below two is paid for with many times the error, and what is made of it pays
  /// again.
  size_t triangles = 32;
  double max_bound = 1e300;      ///< and before a level whose bound is larger; lattice steps
  Colors colors = Colors::keep;  ///< what the bounds hold for
  Simplifier simplifier = Simplifier::collapse;
  Bound bound = Bound::fast;
};

struct Level {
  Piece piece;  ///< sources: indices into the points of the surface that the chain began with
  /// Of the two-sided distance to that surface, lattice steps; never shrinks along the chain.
  double bound = 0;
};

struct Chain {
  /// Finest first, each with at most three quarters of the one before; the input is none.
  std::vector<Level> levels;
  size_t detached_triangles = 0;  ///< of the input: meet the others in a way that half-edges cannot express
  bool stuck = false;             ///< ended before because nothing made it coarser
};

/// Each level has about half of the triangles of the one before it, by the simplifier, or by vertex
/// clustering where that gets stuck or would be further off. Locked points stay in every level, and nothing
/// that hangs together is lost but to clustering, which puts something near in its place.
Chain simplify(const Surface& surface, std::span<const uint8_t> locked, const SimplifyLimits& limits);

}  // namespace triptych
