// Tubes to simplify, and how much area they have.
#pragma once

#include "simplify/surface.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace triptych::test {

inline double area(const Surface& surface) {
  double sum = 0;
  for (const Triangle& triangle : surface.triangles) {
    const auto at = [&](size_t k) { return glm::dvec3(surface.points[triangle.vertices[k]]); };
    sum += glm::length(glm::cross(at(1) - at(0), at(2) - at(0))) / 2;
  }
  return sum;
}

/// A tube around the x axis, of so many rings, closed at both ends. Counts of units of 1,024 steps.
inline Surface wire(double length, double radius, int rings, int sides = 10) {
  Surface tube;
  const auto steps = [](double value) { return static_cast<int>(std::lround(value * 1024)); };
  for (int ring = 0; ring < rings; ++ring) {
    for (int side = 0; side < sides; ++side) {
      const double angle = 2 * std::numbers::pi * side / sides;
      tube.points.emplace_back(steps(length * ring / (rings - 1)), steps(radius * std::cos(angle)),
                               steps(radius * std::sin(angle)));
    }
  }
  const auto at = [&](int ring, int side) { return static_cast<uint32_t>(ring * sides + side % sides); };
  const int last = rings - 1;
  for (int side = 0; side < sides; ++side) {
    for (int ring = 0; ring < last; ++ring) {
      tube.triangles.push_back({{at(ring, side), at(ring, side + 1), at(ring + 1, side + 1)}, 1});
      tube.triangles.push_back({{at(ring, side), at(ring + 1, side + 1), at(ring + 1, side)}, 1});
    }
    if (side == 0 || side == sides - 1) continue;
    tube.triangles.push_back({{at(0, 0), at(0, side + 1), at(0, side)}, 1});
    tube.triangles.push_back({{at(last, 0), at(last, side), at(last, side + 1)}, 1});
  }
  return tube;
}

}  // namespace triptych::test
