#pragma once

#include <glm/glm.hpp>

namespace triptych {

/// A rectangle in plan: x to the east, z to the south; metres.
struct Rect {
  double x0 = 0, z0 = 0, x1 = 0, z1 = 0;

  double width() const { return x1 - x0; }
  double depth() const { return z1 - z0; }
  double area() const { return width() * depth(); }
  glm::dvec2 centre() const { return {(x0 + x1) / 2, (z0 + z1) / 2}; }
  Rect grown(double by) const { return {x0 - by, z0 - by, x1 + by, z1 + by}; }
  bool contains(const Rect& other) const {
    return other.x0 >= x0 && other.x1 <= x1 && other.z0 >= z0 && other.z1 <= z1;
  }
  bool overlaps(const Rect& other) const {
    return other.x0 < x1 && other.x1 > x0 && other.z0 < z1 && other.z1 > z0;
  }
};

}  // namespace triptych
