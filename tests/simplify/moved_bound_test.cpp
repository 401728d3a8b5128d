// The rules of the bound of a level whose points were moved, each where its bound is attained.
#include "simplify/moved_bound.hpp"

#include "tests/support/tight_bound.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

constexpr int far = 1'000'000;

/// Triangles one beside the other, each flat, at these heights.
Surface tiles(const std::vector<int>& heights) {
  Surface surface;
  for (size_t i = 0; i < heights.size(); ++i) {
    const auto first = static_cast<uint32_t>(surface.points.size());
    const int x = 3 * far * static_cast<int>(i);
    for (const glm::ivec2& corner : {glm::ivec2(x, 0), glm::ivec2(x + far, 0), glm::ivec2(x, far)})
      surface.points.push_back({corner, heights[i]});
    surface.triangles.push_back({{first, first + 1, first + 2}, 0});
  }
  return surface;
}

/// The source is flat; the level's triangles were at the first heights, and were moved to the others.
void expect_attained(const std::vector<int>& before, const std::vector<int>& after, bool known) {
  const Surface source = tiles(std::vector<int>(before.size(), 0)), level = tiles(before),
                moved = tiles(after);
  std::vector<double> errors;
  for (const int height : before) errors.push_back(height);
  const double bound = judge::precise_distance(source, level);
  judge::expect_attained(moved_bound(bound, moved, level.points, known ? errors : std::vector<double>{}),
                         judge::precise_distance(source, moved));
}

TEST(MovedBound, is_how_far_a_triangle_was_and_how_far_it_moved) {
  // Either of both is most of the sum, so that neither may shrink.
  for (const bool known : {true, false}) {
    expect_attained({2000}, {2040}, known);
    expect_attained({40}, {2040}, known);
  }
}

TEST(MovedBound, is_that_of_each_triangle_by_itself_where_each_one_s_error_is_known) {
  // What moves far was near, and the other way about.
  expect_attained({2000, 40}, {2040, 1900}, true);
  expect_attained({2000, 40}, {2000, 2700}, true);
}

TEST(MovedBound, is_what_it_was_where_nothing_moves_or_only_what_was_near) {
  expect_attained({2000, 40}, {2000, 40}, true);
  expect_attained({2000, 40}, {2000, 40}, false);
  expect_attained({2000, 0}, {2000, 1000}, true);
}

TEST(MovedBound, goes_by_the_corner_that_moved_furthest) {
  const Surface source = tiles({0});
  for (size_t corner = 0; corner < 3; ++corner) {
    Surface moved = source;
    moved.points[corner].z = 3000;
    judge::expect_attained(moved_bound(0, moved, source.points, std::vector<double>{0}),
                           judge::precise_distance(source, moved));
  }
}

TEST(MovedBound, is_no_more_than_the_bound_and_the_furthest_way_where_errors_are_larger_than_the_bound) {
  // A bound that was measured is smaller than errors that add up.
  const Surface source = tiles({0}), level = tiles({1000}), moved = tiles({1500});
  judge::expect_attained(moved_bound(1000, moved, level.points, std::vector<double>{4000}),
                         judge::precise_distance(source, moved));
}

}  // namespace
}  // namespace triptych
