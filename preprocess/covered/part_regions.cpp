#include "preprocess/covered/part_regions.hpp"

#include "preprocess/triangle_neighbors.hpp"

#include <glm/geometric.hpp>

namespace triptych {

namespace {

glm::dvec3 normal_of(const Surface& surface, const Triangle& triangle) {
  const auto at = [&](size_t k) { return glm::dvec3(surface.points[triangle.vertices[k]]); };
  const glm::dvec3 doubled = glm::cross(at(1) - at(0), at(2) - at(0));
  const double length = glm::length(doubled);
  return length > 0 ? doubled / length : glm::dvec3(0);
}

}  // namespace

PartRegions::PartRegions(const Part& part, const Lattice& lattice) : tree({}) {
  const Surface& surface = part.surface;
  for (const glm::ivec3& point : surface.points) points.push_back(lattice.position(point));
  const TriangleNeighbors neighbors(surface.triangles);
  std::vector<glm::dvec3> normals;
  for (const Triangle& triangle : surface.triangles) normals.push_back(normal_of(surface, triangle));
  std::vector<uint8_t> at_border(points.size(), 0);
  for (const BorderPoint& border : part.borders) at_border[border.point] = 1;
  Box whole;
  for (const glm::dvec3& point : points) whole.extend(point);
  diagonal = triptych::diagonal(whole);
  std::vector<uint8_t> taken(surface.triangles.size(), 0);
  std::vector<uint32_t> front;
  std::vector<Box> boxes;
  for (uint32_t seed = 0; seed < surface.triangles.size(); ++seed) {
    if (taken[seed]) continue;
    SmoothRegion region;
    region.first = static_cast<uint32_t>(triangles.size());
    front = {seed};
    taken[seed] = 1;
    while (!front.empty()) {
      const uint32_t triangle = front.back();
      front.pop_back();
      triangles.push_back(surface.triangles[triangle].vertices);
      numbers.push_back(triangle);
      region_of.push_back(static_cast<uint32_t>(regions.size()));
      Box& box = boxes.emplace_back();
      for (const uint32_t corner : surface.triangles[triangle].vertices) {
        box.extend(points[corner]);
        region.box.extend(points[corner]);
        region.is_cut |= at_border[corner] != 0;
      }
      for (const uint32_t next : neighbors.of(triangle)) {
        if (next == no_id || taken[next] || glm::dot(normals[triangle], normals[next]) < fold_cosine ||
            surface.triangles[next].material != surface.triangles[seed].material)
          continue;
        taken[next] = 1;
        front.push_back(next);
      }
    }
    region.count = static_cast<uint32_t>(triangles.size()) - region.first;
    regions.push_back(region);
  }
  tree = BoxTree(std::move(boxes));
}

}  // namespace triptych
