// Rays through boxes and triangles, in double.
#pragma once

#include "scene/box.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>

namespace triptych {

/// Points from + t * direction with least <= t <= most.
struct RaySpan {
  RaySpan(const glm::dvec3& start, const glm::dvec3& way, double first, double last)
      : from(start), per_step(1.0 / way), least(first), most(last) {}

  /// The least t of a point that it shares with the box, up to rounding; infinite where it shares none.
  double entry(const Box& box) const {
    constexpr double none = std::numeric_limits<double>::infinity();
    double enter = least, leave = most;
    for (int axis = 0; axis < 3; ++axis) {
      if (std::isinf(per_step[axis])) {  // along the box's sides
        if (from[axis] < box.lo[axis] || from[axis] > box.hi[axis]) return none;
        continue;
      }
      const double a = (box.lo[axis] - from[axis]) * per_step[axis];
      const double b = (box.hi[axis] - from[axis]) * per_step[axis];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave ? enter : none;
  }
  bool meets(const Box& box) const { return entry(box) < std::numeric_limits<double>::infinity(); }

  glm::dvec3 from, per_step;
  double least, most;
};

/// Where a ray meets a triangle.
struct TriangleHit {
  double along = 0;     ///< in lengths of the direction
  bool leaves = false;  ///< it passes the triangle from its back to its front
};

/// Moeller and Trumbore, Fast, minimum storage ray/triangle intersection, 1997. Before the start, too.
inline std::optional<TriangleHit> meet_triangle(const glm::dvec3& from, const glm::dvec3& direction,
                                                const glm::dvec3& a, const glm::dvec3& b,
                                                const glm::dvec3& c) {
  const glm::dvec3 ab = b - a, ac = c - a, p = glm::cross(direction, ac);
  const double determinant = glm::dot(ab, p);
  if (determinant == 0) return std::nullopt;
  const glm::dvec3 to = from - a;
  const double u = glm::dot(to, p) / determinant;
  const glm::dvec3 q = glm::cross(to, ab);
  const double v = glm::dot(direction, q) / determinant;
  constexpr double edge = 1e-9;  // no ray passes between two triangles
  if (u < -edge || v < -edge || u + v > 1 + edge) return std::nullopt;
  return TriangleHit{glm::dot(ac, q) / determinant, determinant < 0};
}

}  // namespace triptych
