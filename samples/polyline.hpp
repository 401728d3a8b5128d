// Lines of points that cameras follow: lengths, equal steps, smooth curves.
#pragma once

#include <algorithm>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

namespace triptych {

template <typename Point>
double length_of(const std::vector<Point>& line) {
  double length = 0;
  for (size_t i = 1; i < line.size(); ++i) length += glm::distance(line[i - 1], line[i]);
  return length;
}

/// Points at equal distances along the line, from its start; at most `count`.
template <typename Point>
std::vector<Point> resampled(const std::vector<Point>& line, double step, size_t count) {
  std::vector<Point> result{line.front()};
  double left = step;
  for (size_t i = 1; i < line.size() && result.size() < count; ++i) {
    Point from = line[i - 1];
    double distance = glm::distance(from, line[i]);
    while (distance >= left && result.size() < count) {
      from += (line[i] - from) * (left / distance);
      distance -= left;
      left = step;
      result.push_back(from);
    }
    left -= distance;
  }
  return result;
}

/// A uniform Catmull-Rom spline through the corners, 64 points between each two.
inline std::vector<glm::dvec3> spline_through(const std::vector<glm::dvec3>& corners) {
  std::vector<glm::dvec3> spline;
  for (size_t i = 0; i + 1 < corners.size(); ++i) {
    const glm::dvec3 &a = corners[i == 0 ? 0 : i - 1], &b = corners[i], &c = corners[i + 1],
                     &d = corners[std::min(i + 2, corners.size() - 1)];
    for (int k = 0; k < 64; ++k) {
      const double t = k / 64.0;
      spline.push_back(0.5 * (2.0 * b + (c - a) * t + (2.0 * a - 5.0 * b + 4.0 * c - d) * t * t +
                              (3.0 * b - a - 3.0 * c + d) * t * t * t));
    }
  }
  spline.push_back(corners.back());
  return spline;
}

}  // namespace triptych
