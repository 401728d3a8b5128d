#include "raster/slots.hpp"

#include "tests/raster/opaque_palette.hpp"

#include <array>
#include <gtest/gtest.h>

namespace triptych {
namespace {

/// Without geometry: none of its triangles is in a layer.
const RasterChunk& no_layers() {
  static const RasterChunk chunk(Chunk(), {});
  return chunk;
}

DrawnRange range(uint64_t distance, DrawableId id, uint32_t triangles, uint32_t part = 0,
                 uint32_t first = 0) {
  return {.rank = {distance, id},
          .part = part,
          .first_triangle = first,
          .triangle_count = triangles,
          .chunk = &no_layers()};
}

TEST(SlotTable, names_what_was_numbered) {
  SlotTable slots(1000);
  EXPECT_EQ(slots.add(range(5, 7, 10)), 0u);
  EXPECT_EQ(slots.add(range(3, 9, 4, 2, 100)), 10u);
  EXPECT_EQ(slots.left(), 986u);
  EXPECT_EQ(slots.find(9).range->rank.id, 7u);
  EXPECT_EQ(slots.find(9).triangle, 9u);
  EXPECT_EQ(slots.find(10).range->rank.id, 9u);
  EXPECT_EQ(slots.find(13).triangle, 103u);
}

TEST(SlotTable, at_equal_depth_the_nearer_then_the_lower_id_part_and_triangle_win_whatever_was_first) {
  SlotTable slots(1000);
  const uint32_t far = slots.add(range(5, 1, 2)), near = slots.add(range(3, 9, 2)),
                 lower = slots.add(range(3, 4, 2)), second_part = slots.add(range(3, 4, 2, 1));
  EXPECT_TRUE(slots.precedes(near, far));
  EXPECT_FALSE(slots.precedes(far, near));
  EXPECT_TRUE(slots.precedes(lower, near));
  EXPECT_TRUE(slots.precedes(lower, lower + 1));
  EXPECT_TRUE(slots.precedes(lower + 1, second_part));
  EXPECT_FALSE(slots.precedes(lower, lower));
}

TEST(SlotTable, at_equal_depth_the_higher_layer_wins_over_what_is_nearer) {
  const auto in_layer = [](uint32_t layer) {
    Chunk chunk{.vertices = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}}, .indices = {0, 1, 2}};
    for (ChunkVertex& vertex : chunk.vertices) vertex.layer = layer & max_layer;
    return RasterChunk(chunk, test::opaque_palette);
  };
  const RasterChunk upper = in_layer(1), lower = in_layer(2);
  SlotTable slots(10);
  DrawnRange near = range(3, 1, 1), far = range(5, 2, 1);
  near.chunk = &lower;
  far.chunk = &upper;
  const uint32_t below = slots.add(near), above = slots.add(far);
  EXPECT_TRUE(slots.precedes(above, below));
  EXPECT_FALSE(slots.precedes(below, above));
}

TEST(SlotTable, compaction_keeps_what_pixels_name_and_makes_room) {
  SlotTable slots(12);
  slots.add(range(5, 1, 6));
  slots.add(range(3, 2, 6));
  EXPECT_EQ(slots.left(), 0u);
  PixelPlane depths(5, 1), words(5, 1);
  for (int x = 0; x < 5; ++x) {
    depths.at(x, 0) = x == 0 ? 0 : 0x3f000000u;  // where nothing is, its slot is none
    words.at(x, 0) = std::array{77u, 2u, 11u, 2u, 7u}[static_cast<size_t>(x)];
  }
  std::vector<std::pair<DrawableId, uint32_t>> before, after;
  const auto names = [&](auto& into) {
    for (int x = 0; x < 5; ++x) {
      if (depths.at(x, 0) == 0) continue;
      const auto found = slots.find(words.at(x, 0));
      into.push_back({found.range->rank.id, found.triangle});
    }
  };
  names(before);
  slots.compact(depths, words);
  names(after);
  EXPECT_EQ(before, after);
  EXPECT_EQ(slots.left(), 9u);
  // Twice, with new ones between.
  const uint32_t slot = slots.add(range(1, 3, 9));
  EXPECT_EQ(slots.find(slot + 8).range->rank.id, 3u);
  words.at(0, 0) = slot + 8;
  depths.at(0, 0) = 0x3f000000u;
  before.insert(before.begin(), {3, 8});
  slots.compact(depths, words);
  after.clear();
  names(after);
  EXPECT_EQ(before, after);
  EXPECT_EQ(slots.left(), 8u);
}

}  // namespace
}  // namespace triptych
