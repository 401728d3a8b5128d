// The rules of the bound of vertex clustering, each on a mesh where its bound is attained.
#include "simplify/vertex_clustering.hpp"
#include "tests/support/tight_bound.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace triptych {
namespace {

constexpr double cell = 10000;

/// A triangle with sides of a few steps, and the point as a corner.
void add_crumb(Surface& surface, const glm::ivec3& point, int side) {
  const auto first = static_cast<uint32_t>(surface.points.size());
  for (const glm::ivec3& corner : {glm::ivec3(0), glm::ivec3(side, 0, 0), glm::ivec3(0, side, 0)})
    surface.points.push_back(point + corner);
  surface.triangles.push_back({{first, first + 1, first + 2}, 0});
}

double expect_attained(const Surface& surface, const Clustered& clustered) {
  const double measured = judge::precise_distance(surface, clustered.piece.surface);
  judge::expect_attained(clustered.bound, measured);
  return measured;
}

TEST(ClusteringBound, is_how_far_the_furthest_point_moved) {
  // The tip of an arrow goes to the middle of its base, which is in the same cell.
  Surface arrow;
  arrow.points = {{0, 0, 0},          {9000, 0, 0},      {10001, 20000, 0},
                  {10001, -20000, 0}, {30000, 20000, 0}, {30000, -20000, 0}};
  for (const auto& corners :
       std::vector<std::array<uint32_t, 3>>{{0, 1, 2}, {0, 3, 1}, {1, 4, 2}, {1, 5, 4}, {1, 3, 5}})
    arrow.triangles.push_back({corners, 0});
  const Clustered clustered = cluster_vertices(arrow, {}, cell, Colors::keep);
  EXPECT_EQ(clustered.piece.surface.triangles.size(), 3u);
  EXPECT_EQ(expect_attained(arrow, clustered), 9000);
}

TEST(ClusteringBound, is_twice_that_where_a_triangle_stands_for_others_that_went_to_the_same_point) {
  // All go to the middle, and the largest one stays: the one on the other side of the middle is twice as far.
  Surface crumbs;
  add_crumb(crumbs, {0, 0, 0}, 10);
  add_crumb(crumbs, {4000, 0, 0}, 10);
  add_crumb(crumbs, {8000, 0, 0}, 12);
  const Clustered clustered = cluster_vertices(crumbs, {}, cell, Colors::keep);
  EXPECT_EQ(clustered.piece.surface.triangles.size(), 1u);
  EXPECT_GT(expect_attained(crumbs, clustered), 7900);
}

TEST(ClusteringBound, is_at_most_the_diagonal_of_a_cell_where_a_triangle_stands_for_others) {
  // All go to a corner of the cell where most of them are; the largest one is in the opposite corner, and
  // stays.
  const int end = static_cast<int>(cell) - 30;
  Surface crumbs;
  for (int i = 0; i < 40; ++i) add_crumb(crumbs, {i, i, 0}, 12);
  add_crumb(crumbs, glm::ivec3(end), 13);
  const Clustered clustered = cluster_vertices(crumbs, {}, cell, Colors::keep);
  EXPECT_EQ(clustered.piece.surface.triangles.size(), 1u);
  EXPECT_EQ(clustered.bound, std::sqrt(3.0) * cell);
  expect_attained(crumbs, clustered);
}

// Such a line only ends in nothing that is left where its end was a point that a crumb stood for: so this
// rule is attained together with the one for points, and never alone.
TEST(ClusteringBound, is_twice_that_where_a_triangle_stands_for_others_that_went_to_the_same_line) {
  // Two blades, whose bases are on one line, spread to both sides of it, and go to it. The wider one stays
  // where it is: no third corner makes a triangle with both ends of the line. A crumb is at the far end of
  // the line, and a larger one, at the tip of the wider blade, stands for it.
  Surface blades;
  blades.points = {{0, 5000, 0},      {4000, 5000, 0},   {100000, 9000, 0},
                   {10, 5000, 0},     {3990, 5000, 0},   {100000, 1000, 0},
                   {100000, 5000, 0}, {100010, 5000, 0}, {100000, 5000, 10}};
  blades.triangles = {{{0, 1, 2}, 0}, {{3, 4, 5}, 0}, {{6, 7, 8}, 0}};
  add_crumb(blades, {100000, 8980, 0}, 14);
  const Clustered clustered = cluster_vertices(blades, {}, cell, Colors::keep);
  EXPECT_EQ(clustered.piece.surface.triangles.size(), 2u);
  EXPECT_GT(expect_attained(blades, clustered), 7900);
}

}  // namespace
}  // namespace triptych
