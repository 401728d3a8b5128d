#include "preprocess/leaf.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

/// One placed part whose levels have these triangles; each level's bound is its number.
std::vector<LeafDrawable> drawables_of(const std::vector<uint32_t>& triangles, size_t exit_triangles) {
  PlacedParts parts;
  parts.placed = {PlacedPart{}};
  parts.stretches = {1};
  PartLevels levels;
  for (const uint32_t count : triangles) {
    levels.levels.push_back({0, count, static_cast<double>(levels.levels.size())});
  }
  const std::vector<uint32_t> members = {0};
  return leaf_drawables(parts, std::vector<PartLevels>{levels}, members, exit_triangles);
}

TEST(Leaf, its_drawables_end_with_the_first_that_is_small_enough) {
  const auto drawables = drawables_of({10000, 5000, 300, 100}, 375);
  ASSERT_EQ(drawables.size(), 3u);
  EXPECT_EQ(drawables.back().triangles, 300u);
  EXPECT_EQ(drawables.back().error, 2);
}

TEST(Leaf, what_stays_large_ends_with_its_coarsest_level_even_if_that_saves_little) {
  // HLODs begin with the last drawable, and of large levels only the coarsest are kept for them.
  for (const std::vector<uint32_t>& triangles :
       {std::vector<uint32_t>{1000, 740}, {4000, 2000, 1450}, {500}, {900, 400}}) {
    const auto drawables = drawables_of(triangles, 375);
    EXPECT_EQ(drawables.front().levels[0], 0u);
    EXPECT_EQ(drawables.back().levels[0], triangles.size() - 1) << triangles[0];
    EXPECT_EQ(drawables.back().triangles, triangles.back());
  }
}

}  // namespace
}  // namespace triptych
