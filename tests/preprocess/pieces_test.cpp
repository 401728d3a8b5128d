#include "preprocess/pieces.hpp"

#include "tests/support/hard_surfaces.hpp"

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

double area_of(const LatticeBox& box) { return half_area(Box{glm::dvec3(box.lo), glm::dvec3(box.hi)}); }

Chunk in_pieces(const Surface& surface) { return make_chunk(surface, fitting_pieces(surface)); }

/// Corner by corner, in order.
std::vector<glm::ivec3> corners_of(const Chunk& chunk) {
  std::vector<glm::ivec3> corners;
  for (const uint32_t index : chunk.indices) corners.push_back(chunk.vertices[index].point);
  return corners;
}

TEST(FittingPieces, of_bars_that_cross_have_boxes_that_fit) {
  for (const int count : {2, 6, 8, 40}) {
    const Surface surface = awkward::surface_of(crossing_bars(count));
    const std::vector<LatticeBox> pieces = in_pieces(surface).pieces();
    ASSERT_GT(pieces.size(), 1u) << count;
    EXPECT_LE(pieces.size(), max_pieces);
    double area = 0;
    for (const LatticeBox& piece : pieces) area += area_of(piece);
    EXPECT_LT(area, 0.7 * area_of(surface.box())) << count;
  }
}

TEST(FittingPieces, of_two_bars_are_the_bars) {
  const Chunk chunk = in_pieces(awkward::surface_of(crossing_bars(2)));
  ASSERT_EQ(chunk.pieces().size(), 2u);
  EXPECT_EQ(chunk.vertices.size(), make_chunk(awkward::surface_of(crossing_bars(2))).vertices.size());
}

TEST(FittingPieces, of_a_bent_pipe_cut_it) {
  const Surface pipe = awkward::surface_of(hard::pipe(24, 24));
  const std::vector<LatticeBox> pieces = in_pieces(pipe).pieces();
  EXPECT_GT(pieces.size(), 2u);
  for (const LatticeBox& piece : pieces) EXPECT_LT(area_of(piece), 0.5 * area_of(pipe.box()));
}

TEST(FittingPieces, show_the_triangles_of_any_surface_in_their_order_each_in_one_piece) {
  size_t several = 0;
  for (const auto& [name, surface] : hard::surfaces()) {
    const Chunk chunk = in_pieces(surface);
    EXPECT_EQ(corners_of(chunk), corners_of(make_chunk(surface))) << name;
    for (size_t i = 0; i < chunk.indices.size(); ++i) {
      ASSERT_EQ(chunk.vertices[chunk.indices[i]].piece, chunk.vertices[chunk.indices[i / 3 * 3]].piece)
          << name;
    }
    for (const LatticeBox& piece : chunk.pieces()) ASSERT_FALSE(piece.empty()) << name;
    several += !chunk.pieces().empty();
  }
  EXPECT_GT(several, 0u);
}

TEST(FittingPieces, are_none_where_there_is_nothing_to_gain) {
  EXPECT_TRUE(fitting_pieces(awkward::surface_of(awkward::grid(12, 4, 0))).empty());
  EXPECT_TRUE(fitting_pieces(Surface{}).empty());
}

}  // namespace
}  // namespace triptych
