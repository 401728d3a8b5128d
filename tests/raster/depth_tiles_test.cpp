// The farthest depths of tiles and blocks, against a look at every pixel.
#include "raster/depth_tiles.hpp"

#include "base/threads.hpp"
#include "tests/raster/whole_number.hpp"

#include <algorithm>
#include <bit>
#include <gtest/gtest.h>

namespace triptych {
namespace {

using scenes::Random;

struct Picture {
  Picture(int w, int h) : width(w), height(h), depths(w, h), tiles(w, h) {}

  /// Draws a rectangle where it is nearer.
  void draw(int left, int right, int bottom, int top, float depth) {
    for (int y = bottom; y <= top; ++y) {
      for (int x = left; x <= right; ++x) {
        uint32_t& there = depths.at(x, y);
        there = std::max(there, std::bit_cast<uint32_t>(depth));
      }
    }
    tiles.touch_rows(bottom, top);
    tiles.mark(left, right, bottom, top);
  }
  void refresh() {
    tiles.refresh_rows(depths, 0, height - 1);
    tiles.refresh_blocks();
  }
  float farthest(int square_x, int square_y, int side) const {
    float least = 2;
    for (int y = square_y * side; y < std::min(height, (square_y + 1) * side); ++y) {
      for (int x = square_x * side; x < std::min(width, (square_x + 1) * side); ++x)
        least = std::min(least, std::bit_cast<float>(depths.at(x, y)));
    }
    return least;
  }
  /// How many are not what they are, or where `at_most`, are more.
  size_t wrong(bool at_most) const {
    size_t count = 0;
    const auto compare = [&](float found, float expected) {
      count += at_most ? found > expected : found != expected;
    };
    for (int y = 0; y * DepthTiles::tile < height; ++y) {
      for (int x = 0; x * DepthTiles::tile < width; ++x)
        compare(tiles.farthest(x, y), farthest(x, y, DepthTiles::tile));
    }
    for (int y = 0; y * DepthTiles::block < height; ++y) {
      for (int x = 0; x * DepthTiles::block < width; ++x)
        compare(tiles.farthest_of_block(x, y), farthest(x, y, DepthTiles::block));
    }
    return count;
  }

  int width, height;
  PixelPlane depths;
  DepthTiles tiles;
};

TEST(DepthTiles, hold_the_farthest_depth_once_refreshed_and_never_more_before) {
  Random random(3);
  size_t behind = 0;
  for (int round = 0; round < 60; ++round) {
    Picture picture(whole_number(random, 1, 200), whole_number(random, 1, 200));
    for (int draws = 0; draws < 20; ++draws) {
      const int left = whole_number(random, 0, picture.width - 1),
                right = whole_number(random, left, picture.width - 1),
                bottom = whole_number(random, 0, picture.height - 1),
                top = whole_number(random, bottom, picture.height - 1);
      picture.draw(left, right, bottom, top, static_cast<float>(random.number(0.1, 1)));
      EXPECT_EQ(picture.wrong(true), 0u);
      behind += picture.wrong(false);
      if (draws % 3 != 2) continue;
      picture.refresh();
      ASSERT_EQ(picture.wrong(false), 0u) << picture.width << "x" << picture.height;
    }
    picture.tiles.clear();
    picture.depths.clear();
    EXPECT_EQ(picture.wrong(false), 0u);
  }
  EXPECT_GT(behind, 0u);
}

TEST(DepthTiles, do_not_count_pixels_beyond_the_picture) {
  Picture picture(70, 9);
  picture.draw(0, 69, 0, 8, 0.5f);
  picture.depths.at(0, 0) = std::bit_cast<uint32_t>(0.25f);
  picture.refresh();
  EXPECT_EQ(picture.tiles.farthest(0, 0), 0.25f);
  EXPECT_EQ(picture.tiles.farthest(1, 0), 0.5f);
  EXPECT_EQ(picture.tiles.farthest(8, 1), 0.5f);
  EXPECT_EQ(picture.tiles.farthest_of_block(0, 0), 0.25f);
  EXPECT_EQ(picture.tiles.farthest_of_block(1, 0), 0.5f);
}

TEST(DepthTiles, may_be_refreshed_in_bands) {
  Picture picture(1100, 1000);
  Random random(4);
  for (int draws = 0; draws < 40; ++draws) {
    const int left = whole_number(random, 0, 1099), bottom = whole_number(random, 0, 999);
    picture.draw(left, whole_number(random, left, 1099), bottom, whole_number(random, bottom, 999),
                 static_cast<float>(random.number(0.1, 1)));
  }
  parallel_for(5, [&](size_t i) {
    const int first = static_cast<int>(i) * 200;
    picture.tiles.refresh_rows(picture.depths, first, first + 199);
  });
  picture.tiles.refresh_blocks();
  EXPECT_EQ(picture.wrong(false), 0u);
}

}  // namespace
}  // namespace triptych
