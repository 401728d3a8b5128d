// The rules of the bound of a collapse (docs/algorithms.md), each on a mesh where its bound is attained.
#include "simplify/collapse.hpp"
#include "tests/support/tight_bound.hpp"

#include <cstdint>
#include <gtest/gtest.h>
#include <optional>
#include <utility>
#include <vector>

namespace triptych {
namespace {

/// A surface that is collapsed edge by edge, each time from a point to a given one.
class Collapsing {
 public:
  /// The first `plain` triangles are of one colour, the others of another one.
  Collapsing(std::vector<glm::ivec3> points, const std::vector<std::array<uint32_t, 3>>& triangles,
             size_t plain = SIZE_MAX)
      : collapser_(points.size()) {
    source_.points = std::move(points);
    for (const auto& corners : triangles)
      source_.triangles.push_back({corners, source_.triangles.size() < plain ? 0u : 1u});
    mesh_.emplace(source_);
  }

  /// The bound of this collapse, which is done.
  double collapse(uint32_t point, uint32_t target) {
    const Collapse* const found = collapser_.find(*mesh_, point, target);
    if (found == nullptr) {
      ADD_FAILURE() << point << " cannot go to " << target;
      return 0;
    }
    const double bound = found->bound;
    collapser_.apply(*mesh_);
    return bound;
  }

  /// The same, where the bound is attained.
  void expect_attained(uint32_t point, uint32_t target) {
    const double bound = collapse(point, target);
    judge::expect_attained(bound, judge::precise_distance(source_, mesh_->piece().surface));
  }

  /// Each triangle's own bound holds; the distance of the one that is furthest from the source, and its
  /// bound.
  std::pair<double, double> furthest_triangle() const {
    const Surface result = mesh_->piece().surface;
    const std::vector<double> errors = mesh_->errors();
    const auto source = judge::triangles_of(source_, 0), triangles = judge::triangles_of(result, 0);
    std::pair<double, double> furthest{-1, 0};
    for (size_t i = 0; i < triangles.size(); ++i) {
      const double distance = judge::furthest_of(triangles[i], source);
      EXPECT_LE(distance, errors[i] + 1e-6) << "triangle " << i;
      furthest = std::max(furthest, {distance, errors[i]});
    }
    return furthest;
  }

 private:
  Surface source_;
  std::optional<ShrinkingMesh> mesh_;
  Collapser collapser_;
};

/// So large that slopes are slight: heights are distances.
constexpr int far = 100'000'000;

// Rule 1, a closed fan.

TEST(CollapseBound, of_a_closed_fan_is_the_height_of_the_point_over_what_replaces_it) {
  for (const int height : {1000, -1000}) {
    for (uint32_t target = 1; target <= 3; ++target) {
      Collapsing tent({{0, 0, height}, {far, 0, 0}, {-far, far, 0}, {-far, -far, 0}},
                      {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}});
      tent.expect_attained(0, target);
    }
  }
}

TEST(CollapseBound, of_a_closed_fan_is_the_height_between_an_edge_that_went_and_one_that_came) {
  // The new edge from corner 1 to corner 3 passes over the old one from the point to corner 2 at this height;
  // over the point itself the new surface is half as high.
  for (const int height : {1000, -1000}) {
    for (const uint32_t target : {1u, 3u}) {
      Collapsing saddle({{0, -far / 2, 0}, {far, 0, height}, {0, far, 0}, {-far, 0, height}, {0, -far, 0}},
                        {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}});
      saddle.expect_attained(0, target);
      const auto [distance, bound] = saddle.furthest_triangle();
      judge::expect_attained(bound, distance);
    }
  }
}

/// A tent of this height whose side between two of its four outer corners has another tent on it, near the
/// top. Point 0 is the top, 1 to 4 are the outer corners, 5 is the top of the small tent.
Collapsing tent_on_a_tent(uint32_t side, int height, int small_height) {
  const std::array<glm::ivec3, 4> outer = {{{far, 0, 0}, {0, far, 0}, {-far, 0, 0}, {0, -far, 0}}};
  const glm::ivec3 middle = (outer[side] + outer[(side + 1) % 4]) / 1000;
  std::vector<std::array<uint32_t, 3>> triangles;
  for (uint32_t i = 0; i < 4; ++i) {
    const uint32_t from = 1 + i, to = 1 + (i + 1) % 4;
    if (i == side) {
      triangles.insert(triangles.end(), {{0, from, 5}, {from, to, 5}, {to, 0, 5}});
    } else {
      triangles.push_back({0, from, to});
    }
  }
  return {{{0, 0, height},
           outer[0],
           outer[1],
           outer[2],
           outer[3],
           middle + glm::ivec3(0, 0, height + small_height)},
          triangles};
}

TEST(CollapseBound, of_a_closed_fan_adds_to_what_its_triangles_were_off_before) {
  // Either of both is most of the sum, so that neither may shrink.
  for (const auto& [height, small_height] : {std::pair(2000, 40), {40, 2000}}) {
    for (uint32_t side = 0; side < 4; ++side) {
      for (uint32_t target = 1; target <= 4; ++target) {
        Collapsing tents = tent_on_a_tent(side, height, small_height);
        tents.expect_attained(5, 0);
        tents.expect_attained(0, target);
      }
    }
  }
}

// Rule 2, an open fan whose border stays.

TEST(CollapseBound, of_an_open_fan_is_how_far_the_point_is_from_the_new_border) {
  // A dent in the border of a plate, or a bulge.
  for (const int out : {1000, -1000}) {
    for (const uint32_t target : {1u, 2u}) {
      Collapsing plate({{0, out, 0}, {-far, 0, 0}, {far, 0, 0}, {-far, -far, 0}, {far, -far, 0}},
                       {{0, 1, 3}, {0, 3, 4}, {0, 4, 2}});
      plate.expect_attained(0, target);
    }
  }
}

TEST(CollapseBound, of_an_open_fan_adds_heights_to_how_far_the_point_is_from_the_new_border) {
  // The point lies below the new border; the new edge from corner 2 to corner 3, which lies high, passes near
  // the border, over an edge from the point.
  for (const auto& [low, height] : {std::pair(1000, 50), {50, 1000}}) {
    Collapsing sheet({{0, 0, -low}, {-far, 0, 0}, {far, 0, 0}, {-far, -far / 1000, 2 * height}, {0, -far, 0}},
                     {{0, 1, 3}, {0, 3, 4}, {0, 4, 2}});
    sheet.expect_attained(0, 2);
  }
}

TEST(CollapseBound, of_an_ear_is_how_far_it_stands_out_and_the_triangle_behind_it_takes_that_over) {
  for (const uint32_t target : {1u, 2u}) {
    // On the border of a triangle.
    Collapsing ear({{0, 1000, 0}, {-far, 0, 0}, {far, 0, 0}, {0, -far, 0}}, {{0, 1, 2}, {1, 3, 2}});
    ear.expect_attained(0, target);
  }
}

TEST(CollapseBound, of_an_ear_adds_to_what_its_triangle_was_off_before) {
  // An ear on an ear: the tip of the small one is over that of the large one.
  for (const auto& [out, small_out] : {std::pair(2000, 40), {40, 2000}}) {
    Collapsing ears({{0, out, 0}, {-far, 0, 0}, {far, 0, 0}, {0, -far, 0}, {-far / 1000, out + small_out, 0}},
                    {{0, 1, 2}, {1, 3, 2}, {4, 1, 0}});
    ears.expect_attained(4, 0);
    ears.expect_attained(0, 2);
  }
}

TEST(CollapseBound, that_a_triangle_took_over_is_carried_on) {
  // A fin stands on one of the edges of a tent, near its top; when the fin has gone, the tent goes.
  for (const auto& [height, fin] : {std::pair(2000, 40), {40, 2000}}) {
    for (uint32_t target = 1; target <= 4; ++target) {
      Collapsing tent({{0, 0, height},
                       {far, 0, 0},
                       {0, far, 0},
                       {-far, 0, 0},
                       {0, -far, 0},
                       {far / 1000, 0, height + fin}},
                      {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {0, 1, 5}});
      tent.expect_attained(5, 1);
      tent.expect_attained(0, target);
    }
  }
}

TEST(CollapseBound, of_a_triangle_that_takes_over_less_than_it_is_off_stays) {
  // An ear on the outline of a tent that has gone.
  Collapsing tent(
      {{0, 0, 2000}, {far, 0, 0}, {0, far, 0}, {-far, 0, 0}, {0, -far, 0}, {-far / 2 - 30, far / 2 + 30, 0}},
      {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {2, 5, 3}});
  tent.collapse(0, 1);
  tent.collapse(5, 2);
  const auto [distance, bound] = tent.furthest_triangle();
  judge::expect_attained(bound, distance);
}

// Rule 3, straight to the neighbour. Either of two collapses in one direction is most of the way.

TEST(CollapseBound, straight_to_the_neighbour_is_the_length_of_the_edge) {
  // An arrow's tip, on which another tip stands: both go towards the middle of the base, and their triangles
  // become edges of those behind.
  for (const auto& [length, tip] : {std::pair(10000, 200), {200, 10000}}) {
    Collapsing arrow({{0, 0, 0},
                      {length, 0, 0},
                      {length, 8000, 0},
                      {length, -8000, 0},
                      {30000, 8000, 0},
                      {30000, -8000, 0},
                      {-tip, 0, 0}},
                     {{0, 1, 2}, {0, 3, 1}, {1, 4, 2}, {1, 5, 4}, {1, 3, 5}, {6, 0, 2}, {6, 3, 0}});
    arrow.expect_attained(6, 0);
    arrow.expect_attained(0, 1);
  }
}

TEST(CollapseBound, straight_to_the_neighbour_is_the_length_of_the_edge_for_triangles_that_stay) {
  // On a plate of another colour, which stays as it is, a blade stands on one corner: that goes along the
  // plate, in two steps, until the blade is upright.
  for (const auto& [step, before] : {std::pair(10000, 200), {200, 10000}}) {
    const int whole = step + before;
    Collapsing blade({{0, 0, 0},
                      {before, 0, 0},
                      {whole, 0, 0},
                      {0, far, 0},
                      {0, -far, 0},
                      {-far, 0, 0},
                      {whole, -20000, 30000},
                      {whole, 20000, 30000}},
                     {{0, 5, 4}, {0, 4, 1}, {0, 1, 3}, {0, 3, 5}, {1, 4, 2}, {1, 2, 3}, {0, 6, 7}}, 6);
    blade.expect_attained(0, 1);
    blade.expect_attained(1, 2);
  }
}

TEST(CollapseBound, straight_to_the_neighbour_is_taken_over_by_a_triangle_of_the_star_that_stays) {
  // A tip on one corner of two triangles: the one becomes an edge of the other, which turns upright.
  for (const auto& [length, tip] : {std::pair(10000, 200), {9000, 10000}}) {
    Collapsing corner(
        {{0, 0, 0}, {length, 0, 0}, {length, -8000, 0}, {length + 10, -20000, 20000}, {-tip, 0, 0}},
        {{0, 2, 1}, {0, 3, 2}, {4, 2, 0}});
    corner.expect_attained(4, 0);
    corner.expect_attained(0, 1);
  }
}

}  // namespace
}  // namespace triptych
