// Small things that stand far apart, and the care that their levels take.
#include "simplify/scattered.hpp"

#include "simplify/care.hpp"
#include "simplify/component_covers.hpp"
#include "tests/support/awkward_meshes.hpp"

#include <gtest/gtest.h>
#include <utility>

namespace triptych {
namespace {

/// Boxes with a side of 1,024 steps, so far from each other.
Surface boxes_apart(int count, int apart) {
  const Surface box = awkward::surface_of(awkward::box({0, 0, 0}, {1, 1, 1}, 1));
  Surface all;
  for (int i = 0; i < count * count; ++i) {
    const auto first = static_cast<uint32_t>(all.points.size());
    for (const glm::ivec3& point : box.points)
      all.points.push_back(point + glm::ivec3(i % count, i / count, 0) * apart);
    for (Triangle triangle : box.triangles) {
      for (uint32_t& vertex : triangle.vertices) vertex += first;
      all.triangles.push_back(triangle);
    }
  }
  return all;
}

/// What a level with a bound of so many steps says.
double bound_with_care(const Surface& surface, double bound) {
  std::vector<Level> levels(1);
  levels[0].bound = bound;
  take_care_of_wires(surface, levels);
  take_care_of_scattered(surface, levels);
  return levels[0].bound;
}

TEST(Scattered, things_become_tetrahedra_at_once_that_cover_no_less) {
  const Surface apart = boxes_apart(4, 16384);
  const FirstLevel first = first_level_of_scattered(apart);
  EXPECT_EQ(first.triangles, 64u);
  EXPECT_GE(first.cover, 1);
  SimplifyLimits limits;
  limits.keep_cover = true;
  limits.colors = Colors::ignore;
  const Chain chain = simplify(apart, {}, limits);
  ASSERT_FALSE(chain.levels.empty());
  EXPECT_EQ(chain.levels[0].piece.surface.triangles.size(), 64u);
  double covered = 0;
  const ComponentCovers components(chain.levels[0].piece.surface);
  EXPECT_EQ(components.covers.size(), 16u);
  for (const Cover& cover : components.covers) covered += cover.covered;
  EXPECT_GT(covered, 16 * 1.5 * 1024 * 1024);
}

TEST(Scattered, is_not_what_stands_close_is_alone_or_has_many_triangles) {
  EXPECT_EQ(first_level_of_scattered(boxes_apart(4, 2048)).triangles, 0u);
  EXPECT_EQ(first_level_of_scattered(boxes_apart(1, 0)).triangles, 0u);
  Surface balls;
  for (int i = 0; i < 2; ++i) {
    const Surface ball = awkward::surface_of(awkward::sphere(8));
    const auto first = static_cast<uint32_t>(balls.points.size());
    for (const glm::ivec3& point : ball.points) balls.points.push_back(point + glm::ivec3(i * 60000));
    for (Triangle triangle : ball.triangles) {
      for (uint32_t& vertex : triangle.vertices) vertex += first;
      balls.triangles.push_back(triangle);
    }
  }
  EXPECT_EQ(first_level_of_scattered(balls).triangles, 0u);
}

/// The surface and a plate under all of it.
Surface on_a_plate(Surface surface) {
  const LatticeBox box = surface.box();
  const auto first = static_cast<uint32_t>(surface.points.size());
  for (const auto& [x, y] : {std::pair(box.lo.x, box.lo.y), std::pair(box.hi.x, box.lo.y),
                             std::pair(box.hi.x, box.hi.y), std::pair(box.lo.x, box.hi.y)})
    surface.points.emplace_back(x, y, box.lo.z - 1);
  surface.triangles.push_back({{first, first + 1, first + 2}, 2});
  surface.triangles.push_back({{first, first + 2, first + 3}, 2});
  return surface;
}

TEST(Scattered, what_they_stand_on_does_not_count) {
  const Surface apart = on_a_plate(boxes_apart(4, 16384));
  EXPECT_EQ(scattered_things(apart).covers.size(), 16u);
  EXPECT_EQ(first_level_of_scattered(apart).triangles, 64u + 2);
  EXPECT_GT(bound_with_care(apart, 1200), 1400);
}

TEST(Care, is_taken_of_scattered_things_about_as_large_as_the_bound) {
  const Surface apart = boxes_apart(4, 16384), close = boxes_apart(4, 2048);
  EXPECT_GT(bound_with_care(apart, 1200), 1400);
  EXPECT_EQ(bound_with_care(apart, 600), 600) << "they are larger";
  EXPECT_EQ(bound_with_care(apart, 6000), 6000) << "they are far smaller";
  EXPECT_EQ(bound_with_care(close, 1200), 1200);
}

TEST(Care, is_taken_of_wires_where_a_fifth_of_their_thickness_shows) {
  const Surface wire = awkward::surface_of(awkward::box({0, 0, 0}, {64, 1, 1}, 1));
  const double thickness = ComponentCovers(wire).covers[0].thickness;
  EXPECT_EQ(bound_with_care(wire, thickness / 6), thickness / 6);
  EXPECT_GT(bound_with_care(wire, thickness / 4), thickness);
  const Surface beam = awkward::surface_of(awkward::box({0, 0, 0}, {8, 1, 1}, 1));
  EXPECT_EQ(bound_with_care(beam, 1024), 1024);
}

}  // namespace
}  // namespace triptych
