// Components of a level that are enlarged to the cover of what they stand for.
#include "simplify/cover.hpp"

#include "simplify/simplify.hpp"
#include "simplify/spread_corners.hpp"
#include "tests/support/awkward_meshes.hpp"
#include "tests/support/distance_judge.hpp"
#include "tests/support/wires.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace triptych {
namespace {

using namespace test;

Piece whole(const Surface& surface) {
  Piece piece{surface, {}};
  for (uint32_t i = 0; i < surface.points.size(); ++i) piece.sources.push_back(i);
  return piece;
}

/// Only those triangles of the surface.
template <typename Wanted>
Piece part_of(const Surface& surface, const Wanted& wanted) {
  std::vector<Triangle> triangles;
  for (const Triangle& triangle : surface.triangles) {
    if (wanted(triangle)) triangles.push_back(triangle);
  }
  return extract(surface.points, triangles);
}

/// Boxes of 1/8, 1 apart along x, some higher than others.
Surface row_of_boxes(int count, uint32_t material = 1) {
  Surface all;
  for (int i = 0; i < count; ++i) {
    const Surface box = awkward::surface_of(
        awkward::box({i, i % 3, i / 2 % 2}, {i + 0.125, i % 3 + 0.125, i / 2 % 2 + 0.125}, material));
    const auto first = static_cast<uint32_t>(all.points.size());
    all.points.insert(all.points.end(), box.points.begin(), box.points.end());
    for (Triangle triangle : box.triangles) {
      for (uint32_t& vertex : triangle.vertices) vertex += first;
      all.triangles.push_back(triangle);
    }
  }
  return all;
}

TEST(Cover, of_a_ball_stays_as_it_gets_simpler) {
  const Surface ball = awkward::surface_of(awkward::sphere(24, 4));
  SimplifyLimits limits;
  const Chain loses = simplify(ball, {}, limits);
  limits.keep_cover = true;
  const Chain keeps = simplify(ball, {}, limits);
  ASSERT_EQ(loses.levels.size(), keeps.levels.size());
  EXPECT_LT(area(loses.levels.back().piece.surface), area(ball) * 0.9) << "nothing to keep";
  for (size_t i = 0; i < keeps.levels.size(); ++i) {
    const Level& level = keeps.levels[i];
    EXPECT_GT(area(level.piece.surface), area(ball) * 0.94) << i;
    EXPECT_LT(area(level.piece.surface), area(ball) * 1.06) << i;
    EXPECT_LE(judge::distance(ball, level.piece.surface), level.bound + 1e-6) << i;
    EXPECT_LE(level.bound, loses.levels[i].bound * 1.5 + 1) << i;
    LatticeBox box = ball.box();
    box.lo -= static_cast<int>(level.moved) + 1;
    box.hi += static_cast<int>(level.moved) + 1;
    EXPECT_TRUE(box.contains(level.piece.surface.box())) << i;
  }
}

TEST(Cover, of_a_wire_stays_as_it_gets_simpler_and_it_does_not_get_longer) {
  for (const int rings : {2, 40}) {
    const Surface tube = wire(200, 0.5, rings);
    SimplifyLimits limits;
    limits.triangles = 8;
    const Chain loses = simplify(tube, {}, limits);
    limits.keep_cover = true;
    const Chain keeps = simplify(tube, {}, limits);
    ASSERT_FALSE(keeps.levels.empty());
    EXPECT_LT(area(loses.levels.back().piece.surface), area(tube) * 0.9) << "nothing to keep";
    for (size_t i = 0; i < keeps.levels.size(); ++i) {
      const Level& level = keeps.levels[i];
      EXPECT_GT(area(level.piece.surface), area(tube) * 0.95) << rings << " " << i;
      EXPECT_LT(area(level.piece.surface), area(tube) * 1.05) << rings << " " << i;
      EXPECT_LE(judge::distance(tube, level.piece.surface), level.bound + 1e-6) << rings << " " << i;
      const LatticeBox box = level.piece.surface.box();
      EXPECT_LE(box.hi.x - box.lo.x, 200 * 1024 + 1024) << rings << " " << i;
    }
  }
}

TEST(Cover, of_what_is_thick_somewhere_does_not_hide_that_it_is_thin) {
  // A spiral of wire has much more area than its size tells.
  Surface tube = wire(400, 0.25, 400);
  for (glm::ivec3& point : tube.points) {
    const double turn = point.x / 1024.0 / 4, reach = 8 * 1024.0 + point.y;
    point = glm::ivec3(point.x / 40.0 + point.z, reach * std::cos(turn), reach * std::sin(turn));
  }
  const ComponentCovers components(tube);
  ASSERT_EQ(components.covers.size(), 1u);
  EXPECT_LT(components.covers[0].thickness, 512);
  EXPECT_GT(components.covers[0].thickness, 128);
  const ComponentCovers ball(awkward::surface_of(awkward::sphere(24, 4)));
  EXPECT_NEAR(ball.covers[0].thickness, 4096, 200);
  const ComponentCovers straight(wire(100, 0.5, 2));
  EXPECT_NEAR(straight.covers[0].thickness, 512, 30);
  EXPECT_TRUE(straight.covers[0].is_long());
  EXPECT_FALSE(ball.covers[0].is_long());
}

TEST(Cover, of_what_has_vanished_goes_to_others_of_its_colour) {
  const Surface row = row_of_boxes(8);
  Piece half = part_of(
      row, [&](const Triangle& triangle) { return row.points[triangle.vertices[0]].x / 1024 % 2 == 0; });
  CoverKeeper keeper(row, {});
  const Surface before = half.surface;
  const double moved = keeper.restore(half, 1024);  // one unit: as far as the next box
  EXPECT_NEAR(area(before), area(row) / 2, 1);
  EXPECT_GT(area(half.surface), area(row) * 0.97);
  EXPECT_LT(area(half.surface), area(row) * 1.02);
  EXPECT_GT(moved, 0);
  EXPECT_LE(moved, 512);
  for (size_t i = 0; i < before.points.size(); ++i)
    EXPECT_LE(glm::distance(glm::dvec3(before.points[i]), glm::dvec3(half.surface.points[i])), moved);
  // Not to those of another.
  Surface other = row;
  for (Triangle& triangle : other.triangles)
    triangle.material = row.points[triangle.vertices[0]].x / 1024 % 2;
  Piece even = part_of(other, [](const Triangle& triangle) { return triangle.material == 0; });
  EXPECT_EQ(CoverKeeper(other, {}).restore(even, 1024), 0);
}

TEST(Cover, of_one_colour_is_one_whatever_lies_in_its_planes) {
  Surface row = row_of_boxes(8);
  const auto is_odd = [&](const Triangle& triangle) {
    return row.points[triangle.vertices[0]].x / 1024 % 2 == 1;
  };
  for (Triangle& triangle : row.triangles) {
    if (is_odd(triangle)) triangle.material = material_in_layer(triangle.material, 2);
  }
  Piece even = part_of(row, [&](const Triangle& triangle) { return !is_odd(triangle); });
  EXPECT_GT(CoverKeeper(row, {}).restore(even, 1024), 0);
  EXPECT_GT(area(even.surface), area(row) * 0.97);
}

TEST(Cover, of_what_stands_on_a_plane_does_not_go_through_it) {
  // Boxes that stand on z = 0, under a sheet of another colour; all that lies there has layers.
  Surface row;
  for (int i = 0; i < 12; ++i) {
    Surface box = awkward::surface_of(awkward::box({i, 0, 0}, {i + 0.25, 0.25, 0.25}, 1));
    const auto first = static_cast<uint32_t>(row.points.size());
    for (Triangle& triangle : box.triangles) {
      const auto& corners = triangle.vertices;
      if (std::all_of(corners.begin(), corners.end(),
                      [&](uint32_t corner) { return box.points[corner].z == 0; }))
        triangle.material = material_in_layer(1, 2);
      for (uint32_t& vertex : triangle.vertices) vertex += first;
      row.triangles.push_back(triangle);
    }
    row.points.insert(row.points.end(), box.points.begin(), box.points.end());
  }
  const auto lowest = [&](const LayeredPlanes& planes) {
    Piece few = part_of(
        row, [&](const Triangle& triangle) { return row.points[triangle.vertices[0]].x / 1024 % 3 == 0; });
    EXPECT_GT(CoverKeeper(row, {}, planes).restore(few, 2048), 0);
    return few.surface.box().lo.z;
  };
  EXPECT_EQ(lowest(LayeredPlanes(row)), 0);
  EXPECT_LT(lowest(LayeredPlanes::none()), 0) << "nothing to hold";
}

TEST(Cover, is_not_restored_beyond_the_bound_and_locked_points_stay) {
  const Surface row = row_of_boxes(64);
  const auto first = [&](const Triangle& triangle) { return row.points[triangle.vertices[0]].x < 1024; };
  Piece one = part_of(row, first);
  const double moved = CoverKeeper(row, {}).restore(one, 256);
  EXPECT_LE(moved, 256 + 1) << "it is small";
  EXPECT_GT(moved, 128);
  Piece larger = part_of(row, first);
  EXPECT_LE(CoverKeeper(row, {}).restore(larger, 40), 20 + 1);
  std::vector<uint8_t> locked(row.points.size(), 0);
  locked[0] = 1;
  Piece held = part_of(row, first);
  EXPECT_EQ(CoverKeeper(row, locked).restore(held, 256), 0) << "what is held does not stand for others";
  EXPECT_EQ(held.surface.points, part_of(row, first).surface.points);
  const Surface tube = wire(200, 0.5, 40);
  locked.assign(tube.points.size(), 0);
  std::fill(locked.begin(), locked.begin() + 10, uint8_t{1});  // the first ring
  SimplifyLimits limits;
  limits.triangles = 2;
  Piece inscribed = simplify(tube, locked, limits).levels.back().piece;
  const Piece before = inscribed;
  EXPECT_GT(CoverKeeper(tube, locked).restore(inscribed, 512), 0);
  size_t held_points = 0;
  for (size_t i = 0; i < before.sources.size(); ++i) {
    if (!locked[before.sources[i]]) continue;
    ++held_points;
    EXPECT_EQ(inscribed.surface.points[i], before.surface.points[i]) << i;
  }
  EXPECT_EQ(held_points, 10u);
}

TEST(Cover, of_three_and_four_points_is_spread) {
  const auto spread_in_place = [](const std::vector<glm::dvec3>& points) {
    const std::vector<glm::dvec3> corners = spread_corners(points);
    ASSERT_EQ(corners.size(), points.size());
    glm::dvec3 middle(0);
    for (const glm::dvec3& point : points) middle += point / static_cast<double>(points.size());
    double before = 0, after = 0;
    for (size_t i = 0; i < corners.size(); ++i) {
      EXPECT_NEAR(glm::length(corners[i]), 1, 1e-12);
      before += glm::dot(corners[i], points[i] - middle);
      after += glm::dot(corners[i], points[(i + 1) % corners.size()] - middle);
      for (size_t k = 0; k < i; ++k)
        EXPECT_NEAR(glm::dot(corners[i], corners[k]), corners.size() == 3 ? -0.5 : -1.0 / 3, 1e-12);
    }
    EXPECT_GT(before, after) << "each stays on its side";
    const auto volume = [](std::span<const glm::dvec3> at) {
      return glm::dot(glm::cross(at[1] - at[0], at[2] - at[0]), at.back() - at[0]);
    };
    EXPECT_GE(volume(corners) * volume(points), 0) << "not turned inside out";
  };
  spread_in_place({{0, 0, 0}, {4, 0, 1}, {3, 1, 0}});
  spread_in_place({{0, 0, 0}, {4, 0, 1}, {3, 1, 0}, {2, 2, 3}});
  spread_in_place({{0, 0, 0}, {3, 1, 0}, {4, 0, 1}, {2, 2, 3}});
}

TEST(Cover, of_large_things_and_of_what_lost_nothing_is_left_alone) {
  const Surface ball = awkward::surface_of(awkward::sphere(24, 4));
  Piece same = whole(ball);
  EXPECT_EQ(CoverKeeper(ball, {}).restore(same, 4096), 0);
  const Chain chain = simplify(ball, {}, {});
  Piece simpler = chain.levels.back().piece;
  EXPECT_EQ(CoverKeeper(ball, {}).restore(simpler, 100), 0) << "a radius of 4096 is large against 100";
  // A flat sheet does not grow beyond its outline.
  const Surface sheet = awkward::surface_of(awkward::grid(8, 4, 0));
  Piece part = part_of(sheet, [&](const Triangle& triangle) { return triangle.vertices[0] < 40; });
  EXPECT_EQ(CoverKeeper(sheet, {}).restore(part, 512), 0);
}

}  // namespace
}  // namespace triptych
