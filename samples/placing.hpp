// Where a shared mesh is placed: exact transforms without a sine.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>

namespace triptych {

/// Turned upright by the quarter turns next to `angle`, then moved; a quarter turn takes x to -z.
inline glm::dmat4 placed(const glm::dvec3& position, double angle) {
  const int quarter = static_cast<int>(std::lround(angle / glm::half_pi<double>()));
  const double s[] = {0, 1, 0, -1}, c[] = {1, 0, -1, 0};
  const auto q = static_cast<size_t>(((quarter % 4) + 4) % 4);
  glm::dmat4 transform(1);
  transform[0] = {c[q], 0, -s[q], 0};
  transform[2] = {s[q], 0, c[q], 0};
  transform[3] = {position, 1};
  return transform;
}

/// The mesh's x and y axes point along `x` and `y`, which are of length 1 and square to each other.
inline glm::dmat4 placed_along(const glm::dvec3& position, const glm::dvec3& x, const glm::dvec3& y) {
  return {{x, 0}, {y, 0}, {glm::cross(x, y), 0}, {position, 1}};
}

}  // namespace triptych
