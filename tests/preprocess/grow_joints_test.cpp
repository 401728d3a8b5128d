#include "preprocess/contacts/grow_joints.hpp"

#include "tests/support/awkward_meshes.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace triptych {
namespace {

/// Surfaces side by side, no point shared.
Baked beside(const std::vector<Surface>& surfaces) {
  Baked all;
  for (const Surface& surface : surfaces) {
    const auto first = static_cast<uint32_t>(all.surface.points.size());
    all.surface.points.insert(all.surface.points.end(), surface.points.begin(), surface.points.end());
    for (Triangle triangle : surface.triangles) {
      for (uint32_t& vertex : triangle.vertices) vertex += first;
      all.surface.triangles.push_back(triangle);
    }
  }
  all.spans.resize(all.surface.points.size());
  return all;
}

Surface box(const glm::dvec3& low, const glm::dvec3& high) {
  return awkward::surface_of(awkward::box(low, high, 1));
}

/// Where the first surface's points are, the least and the largest x.
std::pair<int, int> width_of_first(const Baked& baked) {
  const auto end = baked.surface.points.begin() + 8;
  const auto [least, most] =
      std::minmax_element(baked.surface.points.begin(), end, [](auto& a, auto& b) { return a.x < b.x; });
  return {least->x, most->x};
}

double grow(Baked& baked, bool fixed = false, double most = 1000) {
  return grow_joints(baked, std::vector<uint8_t>(baked.surface.points.size(), fixed), most);
}

// awkward::surface_of() has 1024 steps a unit.
const Surface pane = box({0.5, 0.5, -0.1}, {7.5, 9.5, 0.1});
const Surface left = box({-0.5, 0, -1}, {0.5, 40, 1}), right = box({7.5, 0, -1}, {8.5, 40, 1});

TEST(GrowJoints, panes_go_half_way_into_the_mullions_on_both_sides) {
  Baked wall = beside({pane, left, right});
  EXPECT_DOUBLE_EQ(grow(wall), 512);
  EXPECT_EQ(width_of_first(wall), std::pair(0, 8 * 1024));
  for (size_t i = 8; i < wall.surface.points.size(); ++i)
    EXPECT_EQ(wall.surface.points[i], beside({pane, left, right}).surface.points[i]) << "mullions stay";
}

TEST(GrowJoints, panes_of_both_sides_meet) {
  const Surface next = box({8.5, 0.5, -0.1}, {15.5, 9.5, 0.1});
  Baked wall = beside({pane, next, right});
  EXPECT_DOUBLE_EQ(grow(wall), 512);
  size_t met = 0;
  for (size_t i = 0; i < 8; ++i) {
    const auto others = wall.surface.points.begin() + 8;
    met += std::find(others, others + 8, wall.surface.points[i]) != others + 8;
  }
  EXPECT_EQ(met, 4u);
}

TEST(GrowJoints, nothing_grows_into_what_is_no_rod_or_is_thicker_than_may_be) {
  Baked at_a_wall = beside({pane, box({-0.5, 0, -20}, {0.5, 40, 20})});
  EXPECT_EQ(grow(at_a_wall), 0);
  Baked at_a_mullion = beside({pane, left});
  EXPECT_EQ(grow(at_a_mullion, false, 500), 0);
}

TEST(GrowJoints, nothing_grows_past_the_end_of_a_mullion) {
  Baked too_short = beside({pane, box({-0.5, 5, -1}, {0.5, 45, 1})});
  EXPECT_EQ(grow(too_short), 0);
}

TEST(GrowJoints, what_shows_is_not_moved) {
  // A wedge: the faces beside the one that touches are not at right angles to it.
  Surface wedge = pane;
  for (glm::ivec3& point : wedge.points)
    if (point.x > 4000) point.z *= 4;
  Baked wall = beside({wedge, left});
  EXPECT_EQ(grow(wall), 0);
}

TEST(GrowJoints, what_goes_on_elsewhere_stays) {
  Baked wall = beside({pane, left});
  EXPECT_EQ(grow(wall, true), 0);
}

}  // namespace
}  // namespace triptych
