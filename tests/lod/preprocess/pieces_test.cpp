#include "lod/preprocess/pieces.hpp"

#include "tests/support/hard_surfaces.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>

namespace triptych {
namespace {

/// Long boxes, every other one turned upwards, none of them near another.
Mesh crossing_bars(int count) {
  Mesh bars{"bars", {}, {}};
  for (int i = 0; i < count; ++i) {
    const Mesh bar = hard::fine_box(i % 2 ? glm::dvec3(0.1, 4, 0.1) : glm::dvec3(4, 0.1, 0.1), 3);
    const auto first = static_cast<uint32_t>(bars.positions.size());
    for (const glm::dvec3& position : bar.positions) bars.positions.push_back(position + glm::dvec3(0, 0, i));
    for (Triangle triangle : bar.triangles) {
      for (uint32_t& vertex : triangle.vertices) vertex += first;
      bars.triangles.push_back(triangle);
    }
  }
  return bars;
}

double area_of(const Surface& surface) {
  const LatticeBox box = surface.box();
  return half_area(Box{glm::dvec3(box.lo), glm::dvec3(box.hi)});
}

/// Corner by corner, in an order that does not depend on the surface's.
std::vector<std::array<int, 9>> triangles_of(std::span<const Surface> surfaces) {
  std::vector<std::array<int, 9>> triangles;
  for (const Surface& surface : surfaces) {
    for (const Triangle& triangle : surface.triangles) {
      auto& corners = triangles.emplace_back();
      for (size_t i = 0; i < 3; ++i) {
        for (int axis = 0; axis < 3; ++axis)
          corners[3 * i + static_cast<size_t>(axis)] = surface.points[triangle.vertices[i]][axis];
      }
    }
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

TEST(FittingPieces, of_bars_that_cross_have_boxes_that_fit) {
  for (const int count : {2, 6, 8, 12}) {
    const Surface surface = awkward::surface_of(crossing_bars(count));
    const std::vector<Surface> pieces = fitting_pieces(surface);
    ASSERT_GT(pieces.size(), 1u) << count;
    EXPECT_LE(pieces.size(), most_pieces);
    double area = 0;
    for (const Surface& piece : pieces) area += area_of(piece);
    EXPECT_LT(area, 0.8 * area_of(surface)) << count;
    EXPECT_EQ(triangles_of(pieces), triangles_of(std::span(&surface, 1))) << count;
  }
}

TEST(FittingPieces, of_two_bars_are_the_bars) {
  const std::vector<Surface> pieces = fitting_pieces(awkward::surface_of(crossing_bars(2)));
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(pieces[0].triangles.size(), pieces[1].triangles.size());
}

TEST(FittingPieces, hold_every_triangle_of_any_surface) {
  for (const auto& [name, surface] : hard::surfaces()) {
    const std::vector<Surface> pieces = fitting_pieces(surface);
    if (pieces.empty()) continue;
    EXPECT_EQ(triangles_of(pieces), triangles_of(std::span(&surface, 1))) << name;
  }
}

TEST(FittingPieces, are_none_where_there_is_nothing_to_gain) {
  EXPECT_TRUE(fitting_pieces(awkward::surface_of(hard::pipe(24, 24))).empty());
  EXPECT_TRUE(fitting_pieces(awkward::surface_of(hard::rough(12, false))).empty());
  EXPECT_TRUE(fitting_pieces(Surface{}).empty());
}

}  // namespace
}  // namespace triptych
