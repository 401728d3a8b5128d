#include "simplify/scattered.hpp"

#include "simplify/component_covers.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// Of the area of the box.
constexpr double scattered_share = 1.0 / 16;

}  // namespace

bool is_scattered(const Surface& surface) {
  const LatticeBox box = surface.box();
  const glm::dvec3 size = glm::dvec3(box.hi) - glm::dvec3(box.lo);
  const double most = scattered_share * 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
  double area = 0;
  for (const Triangle& triangle : surface.triangles) {
    const auto& [a, b, c] = triangle.vertices;
    area += glm::length(area_normal(surface.points[a], surface.points[b], surface.points[c]));
    if (area > most) return false;
  }
  return true;
}

FirstLevel first_level_of_scattered(const Surface& surface) {
  constexpr size_t few = 16, of_tetrahedron = 4;
  constexpr double regained = 1.2;
  if (!is_scattered(surface)) return {};
  const ComponentCovers components(surface);
  const size_t count = components.covers.size();
  if (count < 2 || surface.triangles.size() > few * count) return {};
  const bool are_compact = std::ranges::all_of(
      components.covers, [](const Cover& cover) { return !cover.is_long() && cover.flatness < 0.5; });
  if (!are_compact) return {};
  return {of_tetrahedron * count, regained};
}

}  // namespace triptych
