// How far apart two surfaces are: a proven bound, not a sample.
#pragma once

#include "simplify/surface.hpp"

#include <limits>
#include <memory>
#include <span>

namespace triptych {

enum class Colors {
  ignore,
  /// Distances are between points of the same colour; a patch of a colour that the other surface has lost
  /// counts with the diagonal of its box, if that is less.
  keep,
};

/// How much work a bound is worth, and what is known already.
struct DistanceEffort {
  double tightness = 1.25;  ///< the bound should be at most this many times the true distance
  double known = std::numeric_limits<double>::infinity();  ///< a valid bound; the result is never larger
  /// For each triangle of the other surface (the second one) a bound of the distance of its points from
  /// points of their colour, by its construction; may be empty. Triangles that are near by this bound are not
  /// measured.
  std::span<const double> known_each = {};
};

/// An upper bound of the two-sided Hausdorff distance, in steps of the common lattice; both surfaces hold at
/// least one triangle. As a rule at most a quarter larger than the true distance, and never below it.
///
/// Branch and bound (as Tang, Lee and Kim, Interactive Hausdorff distance computation for general polygonal
/// models, 2009): triangles are cut into convex polygons until each lies near a single triangle of the other
/// surface: the distance from a convex set is a convex function, so over a polygon it is largest at a corner.
/// The cuts follow the edges of the other surface's triangles, so that a flat region costs as many polygons
/// as triangles overlap in it.
///
/// Corners are measured first: if the distance at one of them shows that the bound known beforehand is tight
/// enough, nothing else is measured.
double distance_bound(const Surface& a, const Surface& b, Colors colors, const DistanceEffort& effort = {});

/// The same for one surface and several others, one after another.
class DistanceMeter {
 public:
  /// The surface is kept by reference.
  DistanceMeter(const Surface& source, Colors colors);
  ~DistanceMeter();
  double bound(const Surface& other, const DistanceEffort& effort = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace triptych
