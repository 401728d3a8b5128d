// How far apart two surfaces are: a proven bound, not a sample.
#pragma once

#include "scene/surface.hpp"

namespace triptych {

enum class Colors {
  ignore,
  /// Every point must find its own colour near; a patch of one colour that the other surface has lost counts
  /// with the diagonal of its box, if that is less.
  keep,
};

/// An upper bound of the two-sided Hausdorff distance, in steps of the common lattice; both surfaces hold at
/// least one triangle. As a rule within a quarter of the truth, and never below it.
///
/// Branch and bound (as Tang, Lee and Kim, Interactive Hausdorff distance computation for general polygonal
/// models, 2009): triangles are cut into convex polygons until each of them lies near one single triangle of
/// the other surface: the distance from a convex set is a convex function, so at the corners of a polygon it
/// is largest. The cuts follow the edges of the other surface's triangles, so that a flat region costs as
/// many polygons as triangles overlap in it.
double distance_bound(const Surface& a, const Surface& b, Colors colors);

}  // namespace triptych
