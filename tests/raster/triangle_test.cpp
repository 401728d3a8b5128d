// Set-up and filling against what a triangle covers, pixel by pixel, in exact arithmetic.
#include "raster/fill.hpp"
#include "tests/support/scenes.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace triptych {
namespace {

using scenes::Random;

constexpr int width = 40, height = 30;
constexpr PictureLimits limits{width, height};

WindowVertex vertex(Random& random, double reach) {
  const auto at = [&](int size) {
    return static_cast<int32_t>(std::floor(random.number(-reach, size + reach) * subpixels));
  };
  const int32_t x = at(width), y = at(height);
  return {x, y, static_cast<float>(random.number(0.01, 1))};
}

/// Whether the edge from a to b, counter-clockwise, holds the point: a left or a top one holds its own
/// points.
bool holds(const WindowVertex& a, const WindowVertex& b, int64_t x, int64_t y) {
  const int64_t side = int64_t{b.x - a.x} * (y - a.y) - int64_t{b.y - a.y} * (x - a.x);
  const bool left = b.y < a.y, top = b.y == a.y && b.x < a.x;
  return side > 0 || (side == 0 && (left || top));
}

bool covers(std::array<WindowVertex, 3> corners, int x, int y) {
  auto& [a, b, c] = corners;
  const int64_t area = int64_t{b.x - a.x} * (c.y - a.y) - int64_t{c.x - a.x} * (b.y - a.y);
  if (area == 0) return false;
  if (area < 0) std::swap(b, c);
  const int64_t px = x * subpixels + subpixels / 2, py = y * subpixels + subpixels / 2;
  return holds(a, b, px, py) && holds(b, c, px, py) && holds(c, a, px, py);
}

/// How often a pixel was written, and what last.
struct Written {
  int count = 0;
  float depth = 0;
};

std::vector<Written> filled(const std::vector<std::array<WindowVertex, 3>>& triangles) {
  std::vector<Written> pixels(static_cast<size_t>(width * height));
  for (const auto& corners : triangles) {
    WindowTriangle triangle;
    if (!set_up(corners, limits, triangle)) continue;
    for_each_pixel(triangle, 0, height - 1, [&](int32_t x, int32_t y, float depth) {
      Written& pixel = pixels[static_cast<size_t>(y * width + x)];
      ++pixel.count;
      pixel.depth = depth;
    });
  }
  return pixels;
}

std::array<WindowVertex, 3> random_triangle(Random& random, int i) {
  const double reach = i % 3 == 0 ? 0 : i % 3 == 1 ? 20 : 8000;
  std::array<WindowVertex, 3> corners = {vertex(random, reach), vertex(random, reach), vertex(random, reach)};
  if (i % 4 == 0) {  // a small one
    for (size_t k = 1; k < 3; ++k) {
      corners[k].x = corners[0].x + static_cast<int32_t>(random.number(-600, 600));
      corners[k].y = corners[0].y + static_cast<int32_t>(random.number(-600, 600));
    }
  }
  if (i % 5 == 0) {  // corners at the middle of pixels, edges along the axes
    for (WindowVertex& corner : corners) {
      corner.x = (corner.x & ~(subpixels - 1)) + subpixels / 2;
      corner.y = (corner.y & ~(subpixels - 1)) + subpixels / 2;
    }
    corners[1].y = corners[0].y;
  }
  if (i % 7 == 0) {  // a sliver
    corners[2].x = (corners[0].x + corners[1].x) / 2 + static_cast<int32_t>(random.number(-3, 3));
    corners[2].y = (corners[0].y + corners[1].y) / 2 + static_cast<int32_t>(random.number(-3, 3));
  }
  return corners;
}

TEST(RasterTriangle, covers_the_pixels_whose_centres_it_holds) {
  Random random(1);
  size_t covered = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto corners = random_triangle(random, i);
    const auto words = filled({corners});
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const bool expected = covers(corners, x, y);
        ASSERT_EQ(words[static_cast<size_t>(y * width + x)].count, expected ? 1 : 0)
            << "triangle " << i << " at " << x << ", " << y;
        covered += expected;
      }
    }
  }
  EXPECT_GT(covered, 100000u);
}

TEST(RasterTriangle, neighbours_share_their_pixels_without_gap_or_overlap) {
  Random random(2);
  for (int round = 0; round < 50; ++round) {
    constexpr int cells = 12;
    std::vector<WindowVertex> corners;
    for (int y = 0; y <= cells; ++y) {
      for (int x = 0; x <= cells; ++x) {
        const double shake = x > 0 && x < cells && y > 0 && y < cells ? 0.24 : 0;
        const auto at = [&](int cell, int size) {
          return static_cast<int32_t>((cell + random.number(-shake, shake)) * size * subpixels / cells);
        };
        const int32_t column = at(x, width), row = at(y, height);
        corners.push_back({column, row, 0.5f});
      }
    }
    std::vector<std::array<WindowVertex, 3>> triangles;
    for (size_t y = 0; y < cells; ++y) {
      for (size_t x = 0; x < cells; ++x) {
        const size_t a = y * (cells + 1) + x, b = a + 1, c = a + cells + 1, d = c + 1;
        triangles.push_back({corners[a], corners[b], corners[d]});
        triangles.push_back({corners[c], corners[d], corners[a]});  // the other way round
      }
    }
    for (const Written& word : filled(triangles)) ASSERT_EQ(word.count, 1);
  }
}

TEST(RasterTriangle, depth_is_as_near_to_the_exact_plane_as_it_says_and_within_its_corners) {
  Random random(3);
  double worst = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto corners = random_triangle(random, i);
    const auto& [a, b, c] = corners;
    WindowTriangle triangle;
    if (!set_up(corners, limits, triangle)) continue;
    const auto words = filled({corners});
    const long double area =
        static_cast<long double>(b.x - a.x) * (c.y - a.y) - static_cast<long double>(c.x - a.x) * (b.y - a.y);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const Written& word = words[static_cast<size_t>(y * width + x)];
        if (word.count == 0) continue;
        const long double px = x * subpixels + subpixels / 2 - a.x, py = y * subpixels + subpixels / 2 - a.y;
        const long double wb = (px * (c.y - a.y) - py * (c.x - a.x)) / area,
                          wc = (py * (b.x - a.x) - px * (b.y - a.y)) / area;
        const long double exact = a.depth + wb * (static_cast<long double>(b.depth) - a.depth) +
                                  wc * (static_cast<long double>(c.depth) - a.depth);
        ASSERT_LE(std::abs(static_cast<double>(exact - word.depth)), triangle.error) << "triangle " << i;
        ASSERT_GE(word.depth, triangle.low);
        ASSERT_LE(word.depth, triangle.high);
        worst = std::max(worst, std::abs(static_cast<double>(exact - word.depth)) / triangle.error);
      }
    }
  }
  EXPECT_GT(worst, 0.01) << "the bound says nothing";
}

TEST(RasterTriangle, a_limit_that_corners_keep_by_more_than_the_error_is_kept_at_every_pixel) {
  Random random(4);
  size_t proven = 0, pixels = 0;
  for (int i = 0; i < 4000; ++i) {
    auto corners = random_triangle(random, i);
    DepthLimit limit{.x = {}, .y = {}, .at = {}, .nearest = 1};
    for (int plane = 0; plane < 3; ++plane) {
      limit.x[plane] = static_cast<float>(random.number(-0.02, 0.02));
      limit.y[plane] = static_cast<float>(random.number(-0.02, 0.02));
      limit.at[plane] = static_cast<float>(random.number(0.2, 1.2));
    }
    // Corners right behind the limit.
    for (WindowVertex& corner : corners) {
      const float room = slack(limit, corner) + corner.depth;
      corner.depth = std::max(0.001f, room * (1 - static_cast<float>(random.number(0, 1e-4))));
    }
    WindowTriangle triangle;
    if (!set_up(corners, limits, triangle)) continue;
    const float least =
        std::min({slack(limit, corners[0]), slack(limit, corners[1]), slack(limit, corners[2])});
    if (!(least >= triangle.error)) continue;
    ++proven;
    const auto words = filled({corners});
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const Written& word = words[static_cast<size_t>(y * width + x)];
        if (word.count == 0) continue;
        ++pixels;
        // Rounding where the limit is evaluated at the pixel.
        const float terms = 8 * 0x1p-24f * (std::abs(limit.x[0]) * width + std::abs(limit.y[0]) * height + 2);
        ASSERT_LE(word.depth, limit_at(limit, x, y) + terms) << "triangle " << i;
      }
    }
  }
  EXPECT_GT(proven, 100u);
  EXPECT_GT(pixels, 1000u);
}

TEST(RasterTriangle, without_area_or_between_centres_covers_nothing) {
  WindowTriangle triangle;
  const auto at = [](int32_t x, int32_t y) { return WindowVertex{x, y, 0.5f}; };
  EXPECT_FALSE(set_up({at(0, 0), at(256, 256), at(512, 512)}, limits, triangle));
  EXPECT_FALSE(set_up({at(140, 140), at(370, 140), at(140, 370)}, limits, triangle));
  EXPECT_FALSE(set_up({at(-900, 0), at(-300, 0), at(-300, 900)}, limits, triangle));
  EXPECT_TRUE(set_up({at(0, 0), at(256, 0), at(0, 256)}, limits, triangle) && triangle.left == 0);
}

}  // namespace
}  // namespace triptych
