#include "simplify/stand_in_shapes.hpp"

#include "simplify/component_covers.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace triptych {

namespace {

/// A prism with its upper corners turned by an angle, up to half a side.
StandInShape turned_prism(uint32_t sides, double first_angle, double turn) {
  StandInShape shape;
  for (const double z : {-1.0, 1.0}) {
    for (uint32_t i = 0; i < sides; ++i) {
      const double angle = first_angle + 2 * std::numbers::pi * i / sides + (z > 0 ? turn : 0);
      shape.corners.emplace_back(std::cos(angle), std::sin(angle), z);
    }
  }
  for (uint32_t i = 0; i < sides; ++i) {
    const uint32_t next = (i + 1) % sides;
    shape.triangles.push_back({i, next, sides + i});
    shape.triangles.push_back({next, sides + next, sides + i});
  }
  for (uint32_t i = 2; i < sides; ++i) {
    shape.triangles.push_back({0, i, i - 1});
    shape.triangles.push_back({sides, sides + i - 1, sides + i});
  }
  return shape;
}

}  // namespace

StandInShape prism(uint32_t sides, double first_angle) { return turned_prism(sides, first_angle, 0); }

StandInShape antiprism(uint32_t sides, double first_angle) {
  return turned_prism(sides, first_angle, std::numbers::pi / sides);
}

StandInShape tetrahedron() {
  return {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
}

double area_of(const StandInShape& shape, const glm::dvec3& scale) {
  double area = 0;
  for (const auto& [a, b, c] : shape.triangles)
    area += glm::length(
        area_normal(shape.corners[a] * scale, shape.corners[b] * scale, shape.corners[c] * scale));
  return area;
}

std::array<glm::dvec3, 3> principal_axes(const std::array<glm::dvec3, 3>& covariance) {
  std::array<glm::dvec3, 3> a = covariance;
  std::array<glm::dvec3, 3> axes = {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)};
  for (int round = 0; round < 24; ++round) {
    for (int p = 0; p < 2; ++p) {
      for (int q = p + 1; q < 3; ++q) {
        if (std::abs(a[p][q]) <= 1e-12 * (std::abs(a[p][p]) + std::abs(a[q][q]))) continue;
        const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (int k = 0; k < 3; ++k) {
          const double kp = a[k][p], kq = a[k][q];
          a[k][p] = c * kp - s * kq;
          a[k][q] = s * kp + c * kq;
        }
        for (int k = 0; k < 3; ++k) {
          const double pk = a[p][k], qk = a[q][k];
          a[p][k] = c * pk - s * qk;
          a[q][k] = s * pk + c * qk;
        }
        const glm::dvec3 old = axes[p];
        axes[p] = c * old - s * axes[q];
        axes[q] = s * old + c * axes[q];
      }
    }
  }
  for (glm::dvec3& axis : axes) axis = glm::normalize(axis);
  return axes;
}

double mean_difference(std::span<const glm::ivec3> a, std::span<const glm::ivec3> b) {
  constexpr int directions = 64;
  const auto reach = [](std::span<const glm::ivec3> points, const glm::dvec3& way) {
    double furthest = -1e300;
    for (const glm::ivec3& point : points) furthest = std::max(furthest, glm::dot(glm::dvec3(point), way));
    return furthest;
  };
  double sum = 0;
  for (int i = 0; i < directions; ++i) {  // evenly over the sphere, along a spiral
    const double z = (2 * i + 1.0) / directions - 1, angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const double across = std::sqrt(1 - z * z);
    const glm::dvec3 way(across * std::cos(angle), across * std::sin(angle), z);
    sum += std::abs(reach(a, way) - reach(b, way));
  }
  return sum / directions;
}

double scale_for(const StandInShape& shape, const glm::dvec3& reach, bool in_all, double area) {
  const auto at = [&](double scale) {
    return area_of(shape, {reach.x * scale, reach.y * scale, in_all ? reach.z * scale : reach.z});
  };
  double low = 0, high = 4;
  if (at(low) >= area || at(high) <= area) return -1;
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    (at(middle) < area ? low : high) = middle;
  }
  return high;
}

}  // namespace triptych
