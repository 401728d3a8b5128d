#include "visibility/silhouette.hpp"

#include "tests/support/scenes.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace triptych {
namespace {

bool holds(const std::array<HalfPlane, 4>& sides, const glm::dvec2& point) {
  for (const HalfPlane& side : sides) {
    if (side.at(static_cast<float>(point.x), static_cast<float>(point.y)) < 0) return false;
  }
  return true;
}

TEST(Silhouette, holds_all_that_is_within_the_margin_of_a_point) {
  scenes::Random random(7);
  int cut = 0;
  for (int round = 0; round < 5000; ++round) {
    const double size = std::exp2(random.number(-12, 4));
    std::vector<glm::dvec2> points;
    for (int i = 0; i < 8; ++i) points.push_back(glm::dvec2(random.vector(-1, 1)) * size);
    const glm::dvec2 margin(random.number(0, 0.01), random.number(0, 0.01));
    const auto sides = silhouette(points, margin);
    for (const glm::dvec2& point : points) {
      for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {
          ASSERT_TRUE(holds(sides, point + glm::dvec2(x, y) * margin)) << "round " << round;
        }
      }
    }
    for (const HalfPlane& side : sides) cut += side.normal.x != 0;
  }
  EXPECT_GT(cut, 5000);
}

TEST(Silhouette, of_a_diamond_leaves_out_the_corners_beyond_the_margin) {
  const std::vector<glm::dvec2> diamond = {{0.5, 0}, {0, 0.25}, {-0.5, 0}, {0, -0.25}};
  const auto sides = silhouette(diamond, {0.02, 0.01});
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      EXPECT_FALSE(holds(sides, {0.5 * x, 0.25 * y}));
      EXPECT_TRUE(holds(sides, {0.26 * x, 0.13 * y}));
      EXPECT_FALSE(holds(sides, {0.28 * x, 0.14 * y}));
    }
  }
}

TEST(Silhouette, of_what_fills_its_rectangle_or_has_no_area_cuts_nothing_that_it_holds) {
  const auto square = silhouette(std::vector<glm::dvec2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {0, 0});
  for (const HalfPlane& side : square) EXPECT_EQ(side.normal, glm::vec2(0));
  const std::vector<glm::dvec2> line = {{0, 0}, {1, 1}, {0.5, 0.5}, {0, 0}}, spot(8, {0.3, 0.3});
  for (const auto& points : {line, spot}) {
    const auto sides = silhouette(points, {0, 0});
    for (const glm::dvec2& point : points) EXPECT_TRUE(holds(sides, point));
  }
}

}  // namespace
}  // namespace triptych
