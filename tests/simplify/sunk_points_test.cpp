// Windows in walls: what of them lies in the wall goes first.
#include "simplify/sunk_points.hpp"

#include "simplify/edge_collapse.hpp"
#include "simplify/vertex_clustering.hpp"
#include "tests/support/awkward_meshes.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace triptych {
namespace {

void append(const Surface& surface, Surface& to) {
  const auto first = static_cast<uint32_t>(to.points.size());
  to.points.insert(to.points.end(), surface.points.begin(), surface.points.end());
  for (Triangle triangle : surface.triangles) {
    for (uint32_t& vertex : triangle.vertices) vertex += first;
    to.triangles.push_back(triangle);
  }
}

Surface box(const glm::dvec3& low, const glm::dvec3& high, uint32_t material) {
  return awkward::surface_of(awkward::box(low, high, material));
}

/// A wall's back is at z = 0, its front at z = 1; windows reach from 1/16 within it to 1/16 before it.
Surface wall_with_windows(int count) {
  Surface surface = box({0, 0, 0}, {2.0 * count + 1, 4, 1}, 0);
  for (int i = 0; i < count; ++i)
    append(box({2.0 * i + 1, 1, 1 - 0x1p-4}, {2.0 * i + 2, 3, 1 + 0x1p-4}, 1), surface);
  return surface;
}

bool is_within(const glm::ivec3& point) { return point.z < 1024; }

TEST(SunkPoints, are_those_within_a_body_that_edges_lead_out_of) {
  const Surface surface = wall_with_windows(3);
  const std::vector<uint8_t> sunk = sunk_points(surface);
  ASSERT_EQ(sunk.size(), surface.points.size());
  for (size_t i = 0; i < sunk.size(); ++i)
    EXPECT_EQ(sunk[i] != 0, i >= 8 && is_within(surface.points[i])) << i;
}

TEST(SunkPoints, need_a_body_that_is_closed_and_not_inside_out) {
  Surface open = wall_with_windows(3);
  open.triangles.erase(open.triangles.begin());
  // The windows are closed, too, and the wall's edges do not pass through them.
  EXPECT_TRUE(sunk_points(open).empty());
  Surface inside_out = wall_with_windows(3);
  for (Triangle& triangle : inside_out.triangles) {
    if (triangle.material == 0) std::swap(triangle.vertices[1], triangle.vertices[2]);
  }
  EXPECT_TRUE(sunk_points(inside_out).empty());
  EXPECT_TRUE(sunk_points(box({0, 0, 0}, {1, 1, 1}, 0)).empty());
}

TEST(SunkPoints, are_corners_of_covered_triangles) {
  Surface surface = box({0, 0, 0}, {1, 1, 1}, 0);
  uint32_t& material = surface.triangles[3].material;
  material = material_covered(material, 9);
  const std::vector<uint8_t> sunk = sunk_points(surface);
  ASSERT_EQ(sunk.size(), 8u);
  EXPECT_EQ(std::ranges::count(sunk, 1), 3);
}

/// Twice the area of what of the windows shows: seen from the front, as far as it is before the wall.
double shown(const Surface& surface) {
  double area = 0;
  for (const Triangle& triangle : surface.triangles) {
    const auto& [a, b, c] = triangle.vertices;
    if (palette_index(triangle.material) != 1) continue;
    if (is_within(surface.points[a]) || is_within(surface.points[b]) || is_within(surface.points[c]))
      continue;
    const glm::dvec3 p(surface.points[a]), q(surface.points[b]), r(surface.points[c]);
    area = std::max(area, 0.0) + std::abs(glm::cross(q - p, r - p).z);
  }
  return area;
}

TEST(SunkPoints, clustering_leaves_fronts_of_windows_before_the_wall) {
  constexpr int count = 6;
  const Surface surface = wall_with_windows(count);
  const Clustered clustered = cluster_vertices(surface, {}, 700, Colors::keep);
  EXPECT_LT(clustered.piece.surface.triangles.size(), surface.triangles.size() / 2);
  EXPECT_EQ(shown(clustered.piece.surface), shown(surface));
}

TEST(SunkPoints, collapses_leave_at_most_one_of_a_window) {
  constexpr int count = 6;
  const Surface surface = wall_with_windows(count);
  EdgeCollapse collapse(surface, {});
  collapse.reduce_to(12 + 4 * count, 1e9);
  const Surface left = collapse.piece().surface;
  const auto within = std::ranges::count_if(left.points, is_within);
  EXPECT_LE(within, 4 + count);  // the back of the wall, and a corner of each: what is closed stays so
}

}  // namespace
}  // namespace triptych
