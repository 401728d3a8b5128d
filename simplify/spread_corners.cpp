#include "simplify/spread_corners.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace triptych {

namespace {

/// Of length 1; any direction if it has none.
glm::dvec3 unit(const glm::dvec3& way, const glm::dvec3& otherwise) {
  const double length = glm::length(way);
  return length > 0 ? way / length : otherwise;
}

/// One across, of length 1.
glm::dvec3 across(const glm::dvec3& axis) {
  return glm::normalize(glm::cross(axis, std::abs(axis.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
}

}  // namespace

std::vector<glm::dvec3> spread_corners(std::span<const glm::dvec3> points) {
  glm::dvec3 middle(0);
  for (const glm::dvec3& point : points) middle += point / static_cast<double>(points.size());
  const bool flat = points.size() == 3;
  // The axis that the last three go around: the plane's normal, or the way to the first.
  const glm::dvec3 normal = glm::cross(points[1] - points[0], points[2] - points[0]);
  const glm::dvec3 axis = unit(flat ? normal : points[0] - middle, {0, 0, 1});
  // Seen from the tip of the axis they go round counter-clockwise, or clockwise.
  const size_t first = flat ? 0 : 1;
  const double volume = flat ? 0 : glm::dot(normal, points[3] - points[0]);
  const double sense = flat || volume < 0 ? 1 : -1;
  const double height = flat ? 0 : -1.0 / 3, reach = std::sqrt(1 - height * height);
  const glm::dvec3 x = across(axis), y = glm::cross(axis, x);
  double cosines = 0, sines = 0;
  std::array<double, 3> angles{};
  for (size_t k = 0; k < 3; ++k) {
    angles[k] = sense * 2 * std::numbers::pi / 3 * static_cast<double>(k);
    const glm::dvec3 way = points[first + k] - middle;
    const double along = glm::dot(way, x), aside = glm::dot(way, y);
    cosines += along * std::cos(angles[k]) + aside * std::sin(angles[k]);
    sines += aside * std::cos(angles[k]) - along * std::sin(angles[k]);
  }
  const double turn = std::atan2(sines, cosines);
  std::vector<glm::dvec3> directions;
  if (!flat) directions.push_back(axis);
  for (const double angle : angles)
    directions.push_back(axis * height + (x * std::cos(angle + turn) + y * std::sin(angle + turn)) * reach);
  return directions;
}

}  // namespace triptych
