#include "visibility/silhouette.hpp"

#include "scene/box.hpp"
#include "tests/support/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

namespace triptych {
namespace {

using scenes::Random;

bool holds(const std::array<HalfPlane, 4>& sides, const glm::dvec2& point) {
  for (const HalfPlane& side : sides) {
    if (side.at(static_cast<float>(point.x), static_cast<float>(point.y)) < 0) return false;
  }
  return true;
}

struct Projected {
  std::array<glm::dvec2, 8> corners;
  FacingSides facing;
};

/// As seen from the origin along −z, or along −z alone, in axes that are turned by `turn`.
Projected project(const Box& box, const glm::dmat3& turn, bool parallel) {
  Projected result;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner = turn * box.corner(i);
    result.corners[static_cast<size_t>(i)] = glm::dvec2(corner) / (parallel ? 1 : -corner.z);
  }
  for (int axis = 0; axis < 3; ++axis) {
    result.facing[static_cast<size_t>(axis)] = {parallel ? turn[axis].z < 0 : box.lo[axis] > 0,
                                                parallel ? turn[axis].z > 0 : box.hi[axis] < 0};
  }
  return result;
}

/// Twice the area that the side cuts off its corner of the rectangle around the points.
double cut_off(const HalfPlane& side, const std::array<glm::dvec2, 8>& points) {
  glm::dvec2 lo(1e300), hi(-1e300);
  for (const glm::dvec2& point : points) {
    lo = glm::min(lo, point);
    hi = glm::max(hi, point);
  }
  const glm::dvec2 normal(side.normal);
  const glm::dvec2 corner(normal.x < 0 ? hi.x : lo.x, normal.y < 0 ? hi.y : lo.y);
  const double outside = -(glm::dot(normal, corner) + side.offset);
  return outside > 0 ? outside * outside / std::abs(normal.x * normal.y) : 0;
}

/// The most that a line through two of the points, with all of them on one side, cuts off any corner.
double most_cut_off(const std::array<glm::dvec2, 8>& points) {
  double most = 0;
  for (const glm::dvec2& a : points) {
    for (const glm::dvec2& b : points) {
      const double length = std::abs(b.x - a.x) + std::abs(b.y - a.y);
      if (!(length > 1e-9)) continue;
      const glm::dvec2 normal = glm::dvec2(a.y - b.y, b.x - a.x) / length;
      if (!(std::abs(normal.x) > 1e-3 && std::abs(normal.y) > 1e-3)) continue;
      const bool outside = std::any_of(points.begin(), points.end(), [&](const glm::dvec2& point) {
        return glm::dot(normal, point - a) < -1e-12;
      });
      if (!outside)
        most = std::max(most, cut_off({glm::vec2(normal), -static_cast<float>(glm::dot(normal, a))}, points));
    }
  }
  return most;
}

TEST(Silhouette, holds_all_that_is_within_the_margin_of_a_corner_and_cuts_off_what_the_hull_does) {
  Random random(7);
  int cut = 0;
  for (int round = 0; round < 20'000; ++round) {
    const bool parallel = round % 3 == 0;
    const glm::dvec3 axis = glm::normalize(random.vector(-1, 1));
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1), random.number(0, 6.3), axis));
    glm::dvec3 half = random.vector(0.01, 1) * std::exp2(random.number(-12, 1));
    if (round % 7 == 0) half[round % 3] = 0;
    glm::dvec3 eye_middle(random.number(-1, 1), random.number(-1, 1), -2 - glm::length(half));
    glm::dvec3 middle = glm::transpose(turn) * eye_middle;
    if (round % 5 == 0) middle[round % 3] = half[round % 3];  // right beside a face
    const Box box{middle - half, middle + half};
    const Projected projected = project(box, turn, parallel);
    bool before = true;
    for (int i = 0; i < 8; ++i) before &= (turn * box.corner(i)).z < -0.1;
    if (!before) continue;
    const glm::dvec2 margin(random.number(0, 0.01), random.number(0, 0.01));
    const auto sides = silhouette(projected.corners, projected.facing, margin);
    for (const glm::dvec2& point : projected.corners) {
      for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0})
          ASSERT_TRUE(holds(sides, point + glm::dvec2(x, y) * margin)) << "round " << round;
      }
    }
    double most = 0;
    for (const HalfPlane& side : silhouette(projected.corners, projected.facing, {0, 0})) {
      cut += side.normal.x != 0;
      if (side.normal.x != 0) most = std::max(most, cut_off(side, projected.corners));
    }
    const double expected = most_cut_off(projected.corners);
    EXPECT_GE(most, 0.999 * expected - 1e-4) << "round " << round;
  }
  EXPECT_GT(cut, 20'000);
}

TEST(Silhouette, of_a_cube_seen_from_a_corner_is_a_hexagon) {
  // Along (1, 1, 1), orthographic: what is cut off the rectangle are its four corners.
  const glm::dvec3 back = glm::normalize(glm::dvec3(1, 1, 1)), right = glm::normalize(glm::dvec3(1, -1, 0)),
                   up = glm::cross(back, right);
  const glm::dmat3 turn = glm::transpose(glm::dmat3(right, up, back));
  const Projected cube = project({glm::dvec3(-0.3), glm::dvec3(0.3)}, turn, true);
  const auto sides = silhouette(cube.corners, cube.facing, {0.01, 0.01});
  for (const HalfPlane& side : sides) EXPECT_NE(side.normal.x, 0);
  EXPECT_TRUE(holds(sides, {0, 0}));
  for (const double x : {-0.4, 0.4}) {
    for (const double y : {-0.47, 0.47}) EXPECT_FALSE(holds(sides, {x, y}));
  }
}

TEST(Silhouette, of_what_fills_its_rectangle_or_has_no_size_cuts_nothing_that_it_holds) {
  const Projected square = project({{-1, -1, -5}, {1, 1, -4}}, glm::dmat3(1), true);
  for (const HalfPlane& side : silhouette(square.corners, square.facing, {0, 0}))
    EXPECT_EQ(side.normal, glm::vec2(0));
  const Projected spot = project({{1, 2, -5}, {1, 2, -5}}, glm::dmat3(1), false);
  for (const HalfPlane& side : silhouette(spot.corners, spot.facing, {0, 0}))
    EXPECT_EQ(side.normal, glm::vec2(0));
}

}  // namespace
}  // namespace triptych
