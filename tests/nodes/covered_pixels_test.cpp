// How many pixels a box covers: the rectangle around it, within the picture.
#include "nodes/covered_pixels.hpp"

#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

class CoveredPixelsTest : public testing::Test {
 protected:
  /// From the origin along −z, 90 degrees, 200 × 100 pixels for tangents of 2 × 1.
  double of(const glm::dvec3& lo, const glm::dvec3& hi, bool parallel = false) {
    FrameState state;
    state.view.camera.left = -1, state.view.camera.right = 1;
    state.view.camera.bottom = -0.5, state.view.camera.top = 0.5;
    state.view.camera.near = 0.5;
    if (parallel) state.view.camera.projection = Projection::orthographic;
    state.view.width = 200, state.view.height = 100;
    const Skeleton& skeleton = scenes::pack("room").skeleton();
    CoveredPixels covered(lattice);
    covered.begin(FrameView(skeleton, state));
    const auto point = [&](const glm::dvec3& p) { return glm::ivec3(p / lattice.step); };
    return covered.by({point(lo), point(hi)});
  }
  const Lattice lattice{{0, 0, 0}, 0x1p-10};
};

TEST_F(CoveredPixelsTest, are_of_the_rectangle_around_its_corners) {
  EXPECT_NEAR(of({-0.25, -0.25, -1}, {0.25, 0.25, -1}), 50 * 50, 1);
  EXPECT_NEAR(of({-0.5, -0.5, -2}, {0.5, 0.5, -2}), 50 * 50, 1) << "twice as large and as far";
  EXPECT_NEAR(of({-0.25, -0.25, -2}, {0.25, 0.25, -1}), 50 * 50, 1)
      << "what is behind is hidden by its front";
  EXPECT_NEAR(of({-0.25, -0.25, -9}, {0.25, 0.25, -7}, true), 50 * 50, 1) << "parallel: wherever it is";
}

TEST_F(CoveredPixelsTest, end_at_the_picture) {
  EXPECT_NEAR(of({-0.25, -9, -1}, {0.25, 9, -1}), 50 * 100, 1);
  EXPECT_NEAR(of({-9, -9, -9}, {9, 9, 9}), 200 * 100, 1) << "the eye is in it";
  EXPECT_EQ(of({3, 0, -1}, {4, 1, -1}), 0);
}

}  // namespace
}  // namespace triptych
