#include "preprocess/contacts/part_rims.hpp"

#include "preprocess/triangle_neighbors.hpp"
#include "simplify/component_covers.hpp"
#include "simplify/key_hash.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <tsl/robin_map.h>

namespace triptych {

namespace {

std::vector<glm::dvec3> positions(const Surface& surface, const Lattice& lattice) {
  std::vector<glm::dvec3> points;
  for (const glm::ivec3& point : surface.points) points.push_back(lattice.position(point));
  return points;
}

BoxTree tree_of(const std::vector<glm::dvec3>& points) {
  std::vector<Box> boxes;
  for (const glm::dvec3& point : points) boxes.push_back({point, point});
  return BoxTree(std::move(boxes));
}

/// Of edges or triangles.
template <size_t corners>
BoxTree tree_of(const std::vector<glm::dvec3>& points,
                const std::vector<std::array<uint32_t, corners>>& elements) {
  std::vector<Box> boxes;
  for (const auto& element : elements) {
    Box& box = boxes.emplace_back();
    for (const uint32_t corner : element) box.extend(points[corner]);
  }
  return BoxTree(std::move(boxes));
}

/// What is known of an edge when some of its triangles have been seen.
struct Sides {
  uint32_t count = 0, material = 0;
  glm::dvec3 normal{0};  ///< of the first triangle; length 1, or 0 without area
  bool forward = false;  ///< it passes from the smaller index to the larger
  bool folds = false;
};

std::vector<std::array<uint32_t, 2>> rims(const Part& part) {
  const Surface& surface = part.surface;
  tsl::robin_map<std::array<uint32_t, 2>, Sides, KeyHash, KeyEqual> all;
  for (const Triangle& triangle : surface.triangles) {
    std::array<glm::dvec3, 3> corners;
    for (size_t k = 0; k < 3; ++k) corners[k] = glm::dvec3(surface.points[triangle.vertices[k]]);
    glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double length = glm::length(normal);
    normal = length > 0 ? normal / length : glm::dvec3(0);
    for (size_t k = 0; k < 3; ++k) {
      std::array<uint32_t, 2> ends = {triangle.vertices[k], triangle.vertices[(k + 1) % 3]};
      const bool forward = ends[0] < ends[1];
      if (!forward) std::swap(ends[0], ends[1]);
      Sides& sides = all[ends];
      if (sides.count++ == 0) {
        sides.material = triangle.material;
        sides.normal = normal;
        sides.forward = forward;
      } else {
        const double turned = glm::dot(sides.normal, normal) * (forward == sides.forward ? -1 : 1);
        sides.folds |= sides.material != triangle.material || turned < fold_cosine;
      }
    }
  }
  std::vector<uint8_t> on_border(surface.points.size(), 0);
  for (const BorderPoint& border : part.borders) on_border[border.point] = 1;
  std::vector<std::array<uint32_t, 2>> edges;
  for (const auto& [ends, sides] : all) {
    const bool is_cut = sides.count == 1 && on_border[ends[0]] && on_border[ends[1]];
    if ((sides.count != 2 || sides.folds) && !is_cut) edges.push_back(ends);
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

std::vector<uint8_t> points_of_no_rod(const Surface& surface, const ComponentCovers& components) {
  std::vector<uint8_t> others;
  for (size_t i = 0; i < surface.points.size(); ++i) {
    others.push_back(!components.covers[components.component_of[i]].is_rod());
  }
  return others;
}

std::vector<std::array<uint32_t, 3>> sides_of_rods(const Surface& surface,
                                                   const ComponentCovers& components) {
  std::vector<std::array<uint32_t, 3>> sides;
  for (const Triangle& triangle : surface.triangles) {
    if (components.covers[components.component_of[triangle.vertices[0]]].is_rod())
      sides.push_back(triangle.vertices);
  }
  return sides;
}

}  // namespace

PartRims::PartRims(const Part& part, const Lattice& lattice)
    : PartRims(part, lattice, ComponentCovers(part.surface)) {}

PartRims::PartRims(const Part& part, const Lattice& lattice, const ComponentCovers& components)
    : points(positions(part.surface, lattice)),
      point_tree(tree_of(points)),
      edges(rims(part)),
      edge_tree(tree_of(points, edges)),
      of_no_rod(points_of_no_rod(part.surface, components)),
      sides(sides_of_rods(part.surface, components)),
      side_tree(tree_of(points, sides)) {}

}  // namespace triptych
