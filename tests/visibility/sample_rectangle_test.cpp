#include "visibility/sample_rectangle.hpp"

#include "tests/support/scenes.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace triptych {
namespace {

TEST(SamplePlaces, are_as_many_as_asked_for_and_no_two_share_a_row_or_a_column) {
  for (const uint32_t samples : {1u, 4u, 8u, 16u}) {
    ASSERT_TRUE(is_sample_count(samples));
    std::set<int> columns, rows;
    int x = 0, y = 0;
    for (const SamplePlace& place : sample_places(samples)) {
      EXPECT_TRUE(std::abs(place.x) < 16 && std::abs(place.y) < 16);
      columns.insert(place.x);
      rows.insert(place.y);
      x += place.x;
      y += place.y;
    }
    EXPECT_EQ(sample_places(samples).size(), samples);
    EXPECT_EQ(columns.size(), samples);
    EXPECT_EQ(rows.size(), samples);
    EXPECT_EQ(x, 0) << "their mean is the centre";
    EXPECT_EQ(y, 0);
  }
  for (const uint64_t other : {0ull, 2ull, 3ull, 5ull, 32ull, (1ull << 32) + 4})
    EXPECT_FALSE(is_sample_count(other));
}

TEST(SampleRectangle, is_at_pixel_centres_what_the_rectangle_is_at_samples) {
  scenes::Random random(4);
  const auto number = [&](double least, double most) {
    return static_cast<float>(random.number(least, most));
  };
  constexpr int width = 640, height = 97;
  for (int i = 0; i < 200; ++i) {
    ScreenRectangle rectangle{.left = number(-1, 0),
                              .bottom = number(-1, 0),
                              .right = number(0, 1),
                              .top = number(0, 1),
                              .planes = {},
                              .cuts = {}};
    for (DepthPlane& plane : rectangle.planes) plane = {{number(-2, 2), number(-2, 2)}, number(-1, 1)};
    for (HalfPlane& cut : rectangle.cuts) cut = {{number(-1, 1), number(-1, 1)}, number(-1, 1)};
    for (const SamplePlace& place : sample_places(16)) {
      const ScreenRectangle seen = at_sample(rectangle, place, width, height);
      const glm::dvec2 offset = 2.0 * place.pixels() / glm::dvec2(width, height);
      EXPECT_NEAR(seen.left + offset.x, rectangle.left, 1e-6);
      EXPECT_NEAR(seen.right + offset.x, rectangle.right, 1e-6);
      EXPECT_NEAR(seen.bottom + offset.y, rectangle.bottom, 1e-6);
      EXPECT_NEAR(seen.top + offset.y, rectangle.top, 1e-6);
      const float x = number(-1, 1), y = number(-1, 1);
      const auto sample_x = static_cast<float>(x + offset.x), sample_y = static_cast<float>(y + offset.y);
      EXPECT_NEAR(seen.depth(x, y), rectangle.depth(sample_x, sample_y), 2e-6);
      for (size_t k = 0; k < 4; ++k)
        EXPECT_NEAR(seen.cuts[k].at(x, y), rectangle.cuts[k].at(sample_x, sample_y), 1e-6);
    }
  }
}

}  // namespace
}  // namespace triptych
