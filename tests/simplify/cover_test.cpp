// Components of a level that are enlarged to the cover of what they stand for.
#include "simplify/cover.hpp"

#include "simplify/simplify.hpp"
#include "tests/support/awkward_meshes.hpp"
#include "tests/support/distance_judge.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

double area(const Surface& surface) {
  double sum = 0;
  for (const Triangle& triangle : surface.triangles) {
    const auto at = [&](size_t k) { return glm::dvec3(surface.points[triangle.vertices[k]]); };
    sum += glm::length(glm::cross(at(1) - at(0), at(2) - at(0))) / 2;
  }
  return sum;
}

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
    const LatticeBox box = level.piece.surface.box();
    EXPECT_TRUE(ball.box().contains(box)) << i;
  }
}

TEST(Cover, of_what_has_vanished_goes_to_others_of_its_colour) {
  const Surface row = row_of_boxes(8);
  Piece half = part_of(
      row, [&](const Triangle& triangle) { return row.points[triangle.vertices[0]].x / 1024 % 2 == 0; });
  const CoverKeeper keeper(row, {});
  const Surface before = half.surface;
  const double moved = keeper.restore(half, 1024);  // one unit: as far as the next box
  EXPECT_NEAR(area(before), area(row) / 2, 1);
  EXPECT_GT(area(half.surface), area(row) * 0.8) << "those at the edge of the box cannot grow beyond it";
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

TEST(Cover, is_not_restored_beyond_half_of_the_bound_nor_where_points_are_locked) {
  const Surface row = row_of_boxes(64);
  const auto first = [&](const Triangle& triangle) { return row.points[triangle.vertices[0]].x < 1024; };
  Piece one = part_of(row, first);
  const double moved = CoverKeeper(row, {}).restore(one, 256);
  EXPECT_LE(moved, 128 + 1);
  EXPECT_GT(moved, 90);
  std::vector<uint8_t> locked(row.points.size(), 0);
  locked[0] = 1;
  Piece held = part_of(row, first);
  EXPECT_EQ(CoverKeeper(row, locked).restore(held, 256), 0);
  EXPECT_EQ(held.surface.points, part_of(row, first).surface.points);
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
