// What triangles leave open of a rectangle in their plane.
#include "cells/open_area.hpp"

#include "tests/support/scenes.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace triptych {
namespace {

constexpr double least = 1e-6;

void add_rectangle(const glm::dvec2& lo, const glm::dvec2& hi, std::vector<WallTriangle>& triangles) {
  triangles.push_back({{lo, {hi.x, lo.y}, hi}});
  triangles.push_back({{lo, hi, {lo.x, hi.y}}});
}

double area_of(const std::vector<FlatRectangle>& rectangles) {
  double area = 0;
  for (const FlatRectangle& of : rectangles) area += of.size().x * of.size().y;
  return area;
}

bool holds(const std::vector<FlatRectangle>& rectangles, const glm::dvec2& point) {
  return std::any_of(rectangles.begin(), rectangles.end(), [&](const FlatRectangle& of) {
    return point.x >= of.lo.x && point.x <= of.hi.x && point.y >= of.lo.y && point.y <= of.hi.y;
  });
}

bool covers(const WallTriangle& triangle, const glm::dvec2& point) {
  for (size_t k = 0; k < 3; ++k) {
    const glm::dvec2 side = triangle.corners[(k + 1) % 3] - triangle.corners[k],
                     to = point - triangle.corners[k];
    if (side.x * to.y - side.y * to.x < 0) return false;
  }
  return true;
}

TEST(OpenArea, of_nothing_is_all_and_of_a_whole_wall_none) {
  const FlatRectangle face{{0, 0}, {4, 3}};
  EXPECT_DOUBLE_EQ(area_of(open_area(face, {}, least)), 12);
  std::vector<WallTriangle> wall;
  add_rectangle({0, 0}, {4, 3}, wall);
  EXPECT_TRUE(open_area(face, wall, least).empty());
  EXPECT_DOUBLE_EQ(covered_area(face, wall), 12);
  EXPECT_DOUBLE_EQ(covered_area({{2, 1}, {9, 9}}, wall), 4);
}

TEST(OpenArea, of_a_wall_with_a_door_is_the_door) {
  std::vector<WallTriangle> wall;
  add_rectangle({0, 0}, {1, 3}, wall);
  add_rectangle({2, 0}, {4, 3}, wall);
  add_rectangle({1, 2}, {2, 3}, wall);
  const auto open = open_area({{0, 0}, {4, 3}}, wall, least);
  ASSERT_EQ(open.size(), 1u);
  EXPECT_LT(glm::distance(open[0].lo, glm::dvec2(1, 0)), 1e-9);
  EXPECT_LT(glm::distance(open[0].hi, glm::dvec2(2, 2)), 1e-9);
}

TEST(OpenArea, of_pieces_that_touch_is_closed_and_of_those_that_gape_is_not) {
  for (const double gap : {0.0, 0.5 * least, 100 * least}) {
    std::vector<WallTriangle> wall;
    add_rectangle({0, 0}, {2, 3}, wall);
    add_rectangle({2 + gap, 0}, {4, 3}, wall);
    EXPECT_EQ(open_area({{0, 0}, {4, 3}}, wall, least).empty(), gap < least) << gap;
  }
}

TEST(OpenArea, holds_every_point_that_no_triangle_covers) {
  scenes::Random random(3);
  const FlatRectangle face{{-1, -2}, {3, 2}};
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<WallTriangle> wall(1 + random.index(24));
    for (WallTriangle& triangle : wall) {
      for (glm::dvec2& corner : triangle.corners) corner = glm::dvec2(random.vector(-3, 4));
      const glm::dvec2 a = triangle.corners[1] - triangle.corners[0],
                       b = triangle.corners[2] - triangle.corners[0];
      if (a.x * b.y - a.y * b.x < 0) std::swap(triangle.corners[1], triangle.corners[2]);
    }
    const auto open = open_area(face, wall, 1e-9);
    for (int i = 0; i < 300; ++i) {
      const glm::dvec2 point(random.number(-1, 3), random.number(-2, 2));
      const bool covered =
          std::any_of(wall.begin(), wall.end(), [&](const WallTriangle& of) { return covers(of, point); });
      EXPECT_TRUE(covered || holds(open, point)) << trial;
    }
  }
}

}  // namespace
}  // namespace triptych
