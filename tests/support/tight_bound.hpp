// A judge that notices a bound which is two per cent too small, on small meshes whose bound is nearly
// attained.
#pragma once

#include "tests/support/distance_judge.hpp"

#include <gtest/gtest.h>

namespace triptych::judge {

/// The distance of the point from the nearest of the triangles, by plain search.
inline double distance_to(const glm::dvec3& p, const std::vector<Corners>& triangles) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Corners& triangle : triangles) nearest = std::min(nearest, distance_to_triangle(p, triangle));
  return nearest;
}

/// The largest distance that a point of a triangle has from the others: a grid on the triangle, then smaller
/// and smaller grids around the furthest point of the one before. A distance that some point really has, so
/// never more than the truth.
inline double furthest_of(const Corners& from, const std::vector<Corners>& to) {
  constexpr int steps = 16, zooms = 20;
  double largest = 0, u = 0.5, v = 0.5, reach = 0.5;
  for (int zoom = 0; zoom < zooms; ++zoom) {
    const double around_u = u, around_v = v;
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; j <= steps; ++j) {
        const double at_u = std::clamp(around_u + reach * (2.0 * i / steps - 1), 0.0, 1.0),
                     at_v = std::clamp(around_v + reach * (2.0 * j / steps - 1), 0.0, 1.0 - at_u);
        const double distance =
            distance_to(from[0] + (from[1] - from[0]) * at_u + (from[2] - from[0]) * at_v, to);
        if (distance > largest) largest = distance, u = at_u, v = at_v;
      }
    }
    reach *= 0.5;
  }
  return largest;
}

/// The two-sided distance of two small surfaces, each colour by itself: a little below the truth, or the
/// truth. Infinite where a colour has gone.
inline double precise_distance(const Surface& a, const Surface& b) {
  std::set<uint32_t> materials;
  for (const Surface* surface : {&a, &b}) {
    for (const Triangle& triangle : surface->triangles) materials.insert(triangle.material);
  }
  double largest = 0;
  for (const uint32_t material : materials) {
    const auto of_a = triangles_of(a, material), of_b = triangles_of(b, material);
    for (const Corners& triangle : of_a) largest = std::max(largest, furthest_of(triangle, of_b));
    for (const Corners& triangle : of_b) largest = std::max(largest, furthest_of(triangle, of_a));
  }
  return largest;
}

/// The bound holds, and is at most one per cent larger than what was measured: were it two per cent smaller,
/// it would not hold.
inline void expect_attained(double bound, double measured) {
  EXPECT_LE(measured, bound + 1e-6) << "the bound does not hold";
  EXPECT_GE(measured, 0.99 * bound) << "the bound is not attained here: it could shrink unnoticed";
}

}  // namespace triptych::judge
