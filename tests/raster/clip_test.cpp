#include "raster/clip.hpp"

#include "raster/triangle.hpp"
#include "tests/support/scenes.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace triptych {
namespace {

using scenes::Random;

constexpr float near = 0.125f;
constexpr int width = 640, height = 480;

glm::vec4 perspective(Random& random, double reach) {
  const auto number = [&] { return static_cast<float>(random.number(-reach, reach)); };
  const float x = number(), y = number();
  return {x, y, near, number()};
}

ClippedPolygon clip(const std::array<glm::vec4, 3>& corners, const WindowTransform& window) {
  std::array<ClipCorner, 3> with_exact;
  for (size_t i = 0; i < 3; ++i) with_exact[i] = {corners[i], glm::dvec4(corners[i])};
  return clip_triangle(with_exact, window);
}

bool same_place(const WindowVertex& a, const WindowVertex& b) {
  return a.x == b.x && a.y == b.y && a.depth == b.depth;
}

TEST(Clip, neighbours_get_the_same_points_on_the_edge_that_they_share) {
  const WindowTransform window(width, height);
  Random random(1);
  size_t shared = 0;
  for (int i = 0; i < 3000; ++i) {
    const double reach = i % 2 == 0 ? 1 : 100;
    const glm::vec4 a = perspective(random, reach), b = perspective(random, reach);
    const ClippedPolygon one = clip({a, b, perspective(random, reach)}, window),
                         other = clip({b, a, perspective(random, reach)}, window);
    // Whatever stands on the edge's line in one of them does in the other: ends, or cut ends.
    const ClippedPolygon edge = clip({a, b, b}, window);
    for (size_t k = 0; k < edge.count; ++k) {
      for (const ClippedPolygon* polygon : {&one, &other}) {
        if (polygon->count == 0) continue;
        const auto end = polygon->corners.begin() + static_cast<std::ptrdiff_t>(polygon->count);
        EXPECT_TRUE(
            std::any_of(polygon->corners.begin(), end,
                        [&](const WindowVertex& corner) { return same_place(corner, edge.corners[k]); }))
            << "round " << i;
        ++shared;
      }
    }
  }
  EXPECT_GT(shared, 1000u);
}

TEST(Clip, keeps_what_lies_behind_the_near_plane_and_within_the_guard_band) {
  const WindowTransform window(width, height);
  Random random(2);
  size_t cut = 0;
  for (int i = 0; i < 3000; ++i) {
    const ClippedPolygon polygon =
        clip({perspective(random, 1000), perspective(random, 1000), perspective(random, 1000)}, window);
    cut += polygon.count > 3;
    for (size_t k = 0; k < polygon.count; ++k) {
      const WindowVertex& corner = polygon.corners[k];
      EXPECT_LE(std::abs(corner.x - width * subpixels / 2), guard_band + guard_band / 2 + 1);
      EXPECT_LE(std::abs(corner.y - height * subpixels / 2), guard_band + guard_band / 2 + 1);
      EXPECT_GT(corner.depth, 0);
      EXPECT_LE(corner.depth, 1.00001f);
    }
  }
  EXPECT_GT(cut, 300u);
}

TEST(Clip, drops_what_lies_before_the_near_plane_or_is_no_number) {
  const WindowTransform window(width, height);
  const float nothing = std::numeric_limits<float>::quiet_NaN(), infinite = HUGE_VALF;
  const glm::vec4 before{0, 0, near, 0.1f}, behind{0, 0, near, -3};
  EXPECT_EQ(clip({before, behind, before}, window).count, 0u);
  EXPECT_EQ(clip({glm::vec4(nothing), glm::vec4(nothing), glm::vec4(nothing)}, window).count, 0u);
  const glm::vec4 fine{0, 0, near, 1};
  for (const float bad : {nothing, infinite, -infinite}) {
    const ClippedPolygon polygon = clip({fine, {bad, 0, near, 1}, {0, bad, near, 1}}, window);
    for (size_t k = 0; k < polygon.count; ++k) EXPECT_LE(std::abs(polygon.corners[k].x), 2 * guard_band);
  }
}

}  // namespace
}  // namespace triptych
