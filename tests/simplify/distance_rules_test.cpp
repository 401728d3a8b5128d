// The rules by which distances between surfaces are bounded, each where its bound is attained.
#include "simplify/distance.hpp"
#include "simplify/one_sided.hpp"
#include "tests/support/tight_bound.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace triptych {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Bounds need not be tighter than this; here it is less than the judge notices.
constexpr double tightness = 1.001;

double measured(const Corners& piece, const std::vector<Corners>& target) {
  return judge::furthest_of(piece, target);
}

/// Bounds the triangle's distance from the target.
double bound_of(const Corners& piece, const std::vector<Corners>& target, double known_to_occur,
                size_t max_cuts = 0) {
  const TriangleTree tree(target);
  OneSided side(tree, known_to_occur, tightness);
  side.add(piece, infinite);
  return side.finish(max_cuts, infinite);
}

TEST(DistanceRules, a_triangle_is_as_far_from_another_one_as_its_furthest_corner) {
  const std::vector<Corners> floor = {{{{-90000, -90000, 0}, {90000, -90000, 0}, {0, 90000, 0}}}};
  const Corners sloping = {{{-1000, -1000, 2000}, {1000, -1000, 2500}, {0, 1000, 3000}}};
  judge::expect_attained(bound_of(sloping, floor, 3000), measured(sloping, floor));
  // The same where nothing is known beforehand, and nothing is cut.
  judge::expect_attained(bound_of(sloping, floor, 0), measured(sloping, floor));
}

TEST(DistanceRules, a_piece_is_no_further_than_its_middle_and_from_there_its_furthest_corner) {
  // Each corner is far from the triangle that is nearest to the middle; the middle is on it, and the tip
  // points away from all of the target, so that this is as far as the tip is.
  const Corners needle = {{{-1000, 10, 0}, {-1000, -10, 0}, {2000, 0, 0}}};
  const std::vector<Corners> target = {{{{0, 0, 0}, {0, 5, -10}, {0, -5, -10}}},
                                       {{{-1000, -100, 0}, {-1000, 100, 0}, {-1000, 0, -100}}}};
  judge::expect_attained(bound_of(needle, target, 0), measured(needle, target));
}

TEST(DistanceRules, a_piece_is_as_far_as_its_furthest_corner_from_any_triangle_that_has_all_of_them_near) {
  // A small triangle is nearest to the middle, and a large one has all corners near.
  const Corners piece = {{{-30000, -30000, 3000}, {30000, -30000, 3000}, {0, 60000, 3000}}};
  const std::vector<Corners> target = {{{{-10, -10, 3100}, {10, -10, 3100}, {0, 10, 3100}}},
                                       {{{-90000, -90000, 0}, {90000, -90000, 0}, {0, 180000, 0}}}};
  judge::expect_attained(bound_of(piece, target, 3000), measured(piece, target));
}

TEST(DistanceRules, a_piece_is_as_far_as_the_furthest_of_the_parts_that_it_is_cut_into) {
  // A large triangle over two that meet below its middle, one of them lower.
  const Corners piece = {{{-30000, -30000, 3000}, {30000, -30000, 3000}, {0, 60000, 3000}}};
  const std::vector<Corners> target = {{{{0, -90000, 0}, {0, 90000, 0}, {-90000, 0, 0}}},
                                       {{{0, -90000, 0}, {0, 90000, 0}, {90000, 0, 0}}}};
  judge::expect_attained(bound_of(piece, target, 3000, 1000), measured(piece, target));
}

TEST(DistanceRules, bounds_that_are_known_beforehand_hold_for_what_is_not_measured) {
  const std::vector<Corners> floor = {{{{-90000, -90000, 0}, {90000, -90000, 0}, {0, 90000, 0}}}};
  const Corners sloping = {{{-1000, -1000, 2000}, {1000, -1000, 2500}, {0, 1000, 3000}}};
  const TriangleTree tree(floor);
  OneSided side(tree, 2999, tightness);
  side.add(sloping, 3000);
  judge::expect_attained(side.finish(0, infinite), measured(sloping, floor));
}

/// Two squares of two triangles each, one above the other; of this colour.
Surface square(int z, uint32_t material = 0, int side = 20000) {
  Surface surface;
  surface.points = {{0, 0, z}, {side, 0, z}, {side, side, z}, {0, side, z}};
  surface.triangles = {{{0, 1, 2}, material}, {{0, 2, 3}, material}};
  return surface;
}

TEST(DistanceRules, the_bound_of_two_surfaces_is_the_larger_one_of_both_ways) {
  const Surface floor = square(0), above = square(3000);
  const DistanceEffort effort{tightness, infinite, {}};
  judge::expect_attained(distance_bound(floor, above, Colors::keep, effort),
                         judge::precise_distance(floor, above));
  // One has a part that the other lacks: only one way is far.
  Surface more = floor;
  more.points.insert(more.points.end(), {{0, 0, 9000}, {20, 0, 9000}, {0, 20, 9000}});
  more.triangles.push_back({{4, 5, 6}, 0});
  judge::expect_attained(distance_bound(floor, more, Colors::keep, effort),
                         judge::precise_distance(floor, more));
  judge::expect_attained(distance_bound(more, floor, Colors::keep, effort),
                         judge::precise_distance(floor, more));
}

TEST(DistanceRules, a_colour_that_is_lost_counts_with_the_diagonal_of_its_patch) {
  Surface spotted = square(0), plain = square(0);
  spotted.points.insert(spotted.points.end(), {{100, 100, 0}, {5100, 100, 0}, {5100, 2100, 0}});
  spotted.triangles.push_back({{4, 5, 6}, 1});
  const double bound = distance_bound(spotted, plain, Colors::keep, {tightness, infinite, {}});
  judge::expect_attained(bound, std::hypot(5000, 2000));
}

}  // namespace
}  // namespace triptych
