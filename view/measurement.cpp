#include "view/measurement.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <numbers>

namespace triptych {

double angle_degrees(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 left = a - b, right = c - b;
  if (left == glm::dvec3(0) || right == glm::dvec3(0)) return 0;
  return std::atan2(glm::length(glm::cross(left, right)), glm::dot(left, right)) * 180 / std::numbers::pi;
}

PolygonSize polygon_size(std::span<const glm::dvec3> corners) {
  PolygonSize size;
  glm::dvec3 twice(0), middle(0);  // relative to the first corner
  for (size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 a = corners[i] - corners[0], b = corners[(i + 1) % corners.size()] - corners[0];
    twice += glm::cross(a, b);
    middle += a / static_cast<double>(corners.size());
    size.perimeter += glm::distance(a, b);
  }
  size.area = glm::length(twice) / 2;
  if (!(size.area > 0)) return size;
  const glm::dvec3 normal = glm::normalize(twice);
  for (const glm::dvec3& corner : corners)
    size.off_plane = std::max(size.off_plane, std::abs(glm::dot(corner - corners[0] - middle, normal)));
  return size;
}

double path_length(std::span<const glm::dvec3> corners) {
  double length = 0;
  for (size_t i = 1; i < corners.size(); ++i) length += glm::distance(corners[i - 1], corners[i]);
  return length;
}

std::string number_text(double number) {
  const double size = std::abs(number);
  if (size < 5e-13) return "0";
  if (size < 0.1 || size >= 1e12) return fmt::format("{:.4g}", number);
  return fmt::format("{:.3f}", number);
}

}  // namespace triptych
