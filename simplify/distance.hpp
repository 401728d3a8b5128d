// How far apart two surfaces are: a proven bound, not a sample.
#pragma once

#include "simplify/surface.hpp"

#include <limits>
#include <memory>
#include <span>

namespace triptych {

enum class Colors {
  ignore,
  /// Every point must find its own colour near; a patch of one colour that the other surface has lost counts
  /// with the diagonal of its box, if that is less.
  keep,
};

/// How much work a bound is worth, and what need not be found out.
struct DistanceEffort {
  double tightness = 1.25;  ///< the bound is to be at most so many times the truth
  double known = std::numeric_limits<double>::infinity();  ///< a bound that holds; there is none larger
  /// For each triangle of the other surface (the second one) how far its points are at most from points of
  /// their colour, by its construction; may be empty. What is near by that is not looked at.
  std::span<const double> known_each = {};
};

/// An upper bound of the two-sided Hausdorff distance, in steps of the common lattice; both surfaces hold at
/// least one triangle. As a rule within a quarter of the truth, and never below it.
///
/// Branch and bound (as Tang, Lee and Kim, Interactive Hausdorff distance computation for general polygonal
/// models, 2009): triangles are cut into convex polygons until each of them lies near one single triangle of
/// the other surface: the distance from a convex set is a convex function, so at the corners of a polygon it
/// is largest. The cuts follow the edges of the other surface's triangles, so that a flat region costs as
/// many polygons as triangles overlap in it.
///
/// Corners are measured first: where the distance that one of them reaches shows that the bound known
/// beforehand is tight enough, nothing else is.
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
