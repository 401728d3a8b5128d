#include "simplify/scattered.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace triptych {

namespace {

/// Of the area of the box.
constexpr double scattered_share = 1.0 / 16;
/// Radius over the diagonal of the box.
constexpr double small_share = 1.0 / 16;

}  // namespace

SmallThings scattered_things(const Surface& surface) {
  const LatticeBox box = surface.box();
  const glm::dvec3 size = glm::dvec3(box.hi) - glm::dvec3(box.lo);
  const double most = scattered_share * 2 * (size.x * size.y + size.y * size.z + size.z * size.x),
               small = small_share * glm::length(size);
  const ComponentCovers components(surface);
  const auto is_small = [&](const Cover& cover) { return cover.radius <= small; };
  SmallThings things;
  double area = 0;
  for (const Cover& cover : components.covers) {
    if (!is_small(cover)) continue;
    things.covers.push_back(cover);
    area += cover.area;
  }
  if (area > most) return {};
  for (const Triangle& triangle : surface.triangles)
    things.triangles += is_small(components.covers[components.component_of[triangle.vertices[0]]]);
  return things;
}

FirstLevel first_level_of_scattered(const Surface& surface) {
  constexpr size_t few = 16, of_tetrahedron = 4;
  constexpr double regained = 1.2;
  const SmallThings things = scattered_things(surface);
  const size_t count = things.covers.size();
  if (count < 2 || things.triangles > few * count) return {};
  const bool are_compact = std::ranges::all_of(
      things.covers, [](const Cover& cover) { return !cover.is_long() && cover.flatness < 0.5; });
  if (!are_compact) return {};
  return {of_tetrahedron * count + (surface.triangles.size() - things.triangles), regained};
}

}  // namespace triptych
