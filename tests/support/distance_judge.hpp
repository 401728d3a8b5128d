// A second opinion on how far apart two surfaces are: plain search from many points, sharing no code with the
// bounds that it judges. Never more than the truth, but for rounding.
#pragma once

#include "simplify/surface.hpp"
#include "tests/support/corners.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <set>
#include <vector>

namespace triptych::judge {

inline double distance_to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const double along = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
  return glm::distance(p, a + (b - a) * along);
}

/// To the plane, where the foot lies inside all three sides; else to the nearest side.
inline double distance_to_triangle(const glm::dvec3& p, const Corners& t) {
  const glm::dvec3 normal = glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]));
  bool inside = true;
  double nearest = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3 &a = t[i], &b = t[(i + 1) % 3];
    inside = inside && glm::dot(glm::cross(b - a, p - a), normal) >= 0;
    nearest = std::min(nearest, distance_to_segment(p, a, b));
  }
  return inside ? std::min(nearest, std::abs(glm::dot(p - t[0], normal))) : nearest;
}

inline std::vector<Corners> triangles_of(const Surface& surface, uint32_t material) {
  std::vector<Corners> result;
  for (const Triangle& triangle : surface.triangles) {
    if (triangle.material != material) continue;
    Corners corners;
    for (size_t i = 0; i < 3; ++i) corners[i] = glm::dvec3(surface.points[triangle.vertices[i]]);
    result.push_back(corners);
  }
  return result;
}

/// The largest distance from about `count` points, corners and points between them, to the other triangles.
inline double one_sided(const std::vector<Corners>& from, const std::vector<Corners>& to, size_t count) {
  struct Ball {
    glm::dvec3 middle;
    double radius;
  };
  std::vector<Ball> balls;
  for (const Corners& t : to) {
    const glm::dvec3 middle = (t[0] + t[1] + t[2]) / 3.0;
    balls.push_back({middle, std::max({glm::distance(middle, t[0]), glm::distance(middle, t[1]),
                                       glm::distance(middle, t[2])})});
  }
  double area = 0, largest = 0;
  const auto doubled_area = [](const Corners& t) {
    return glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
  };
  for (const Corners& t : from) area += doubled_area(t);
  size_t last = 0;  // the next point is likely near the same triangle
  for (const Corners& t : from) {
    const auto steps = static_cast<size_t>(std::sqrt(2 * doubled_area(t) / area * double(count))) + 1;
    for (size_t i = 0; i <= steps; ++i) {
      for (size_t j = 0; i + j <= steps; ++j) {
        const glm::dvec3 p =
            t[0] + (t[1] - t[0]) * (double(i) / double(steps)) + (t[2] - t[0]) * (double(j) / double(steps));
        double nearest = distance_to_triangle(p, to[last]);
        for (size_t k = 0; k < to.size() && nearest > largest; ++k) {
          if (glm::distance(p, balls[k].middle) - balls[k].radius >= nearest) continue;
          const double distance = distance_to_triangle(p, to[k]);
          if (distance < nearest) nearest = distance, last = k;
        }
        largest = std::max(largest, nearest);
      }
    }
  }
  return largest;
}

/// Both ways, each colour by itself. Infinite where a colour has gone.
inline double distance(const Surface& a, const Surface& b, size_t count = 3000) {
  std::set<uint32_t> materials;
  for (const Surface* surface : {&a, &b}) {
    for (const Triangle& triangle : surface->triangles) materials.insert(triangle.material);
  }
  double largest = 0;
  for (const uint32_t material : materials) {
    const auto from = triangles_of(a, material), to = triangles_of(b, material);
    if (from.empty() || to.empty()) return std::numeric_limits<double>::infinity();
    largest = std::max({largest, one_sided(from, to, count), one_sided(to, from, count)});
  }
  return largest;
}

/// The same where colours do not count.
inline double distance_without_colors(Surface a, Surface b, size_t count = 3000) {
  for (Surface* surface : {&a, &b}) {
    for (Triangle& triangle : surface->triangles) triangle.material = 0;
  }
  return distance(a, b, count);
}

}  // namespace triptych::judge
