#include "measure/path_deviation.hpp"

#include "tests/support/small_pack.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace triptych {
namespace {

using test::small_pack;
using test::SmallPack;
using test::write_pack;

/// From straight above the place, at the given height; 100 pixels a unit of tangent.
FrameRequest above(double height, double pixel_error, double x = 20, double y = 5) {
  FrameRequest frame{4, {{}, pixel_error}};
  frame.state.view.camera.eye = {x, y, height};
  frame.state.view.camera.target = {x, y, 0};
  frame.state.view.camera.up = {0, 1, 0};
  frame.state.view.camera.near = 0.01;
  frame.state.view.camera.left = frame.state.view.camera.bottom = -1;
  frame.state.view.camera.right = frame.state.view.camera.top = 1;
  frame.state.view.width = frame.state.view.height = 200;
  return frame;
}

std::vector<PathDeviation> deviations(const SmallPack& pack, std::vector<std::vector<FrameRequest>> paths) {
  return measure_deviation(Pack(write_pack(pack)), paths, 100'000);
}

}  // namespace

TEST(PathDeviation, of_exact_bounds_is_what_the_cut_was_selected_by) {
  // The root stands 0.5 above its source; its box of 40 by 10 ends 100 below the eye.
  const PathDeviation deviation = deviations(small_pack(), {{above(100.5, 2)}}).front();
  EXPECT_EQ(deviation.drawable, 0u);
  EXPECT_EQ(deviation.frame, 4u);
  EXPECT_NEAR(deviation.pixels_max, 100 * 0.5 * std::sqrt(1 + 0.2 * 0.2 + 0.05 * 0.05) / (100 - 0.5), 1e-9);
  EXPECT_EQ(deviation.drawables, 1u);
  EXPECT_EQ(deviation.drawables_simplified, 1u);
  EXPECT_NEAR(deviation.bound_over_measured.p50, 1, 1e-9);
}

TEST(PathDeviation, of_bounds_that_promise_too_much_exceeds_the_pixel_error) {
  SmallPack pack = small_pack();
  for (const DrawableId id : {0u, 2u, 4u}) pack.skeleton.drawables[id].error = 0.05;
  const PathDeviation deviation = deviations(pack, {{above(100.5, 0.1)}}).front();
  EXPECT_GT(deviation.pixels_max, 0.5);
  EXPECT_NEAR(deviation.bound_over_measured.p50, 0.1, 1e-6);
}

TEST(PathDeviation, of_the_source_is_none_however_near_the_eye_is) {
  const PathDeviation deviation = deviations(small_pack(), {{above(0.2, 1, 4, 4)}}).front();
  EXPECT_GT(deviation.drawables, 0u);
  EXPECT_EQ(deviation.drawables_simplified, 0u);
  EXPECT_EQ(deviation.pixels_max, 0);
  EXPECT_EQ(deviation.drawable, no_id);
}

TEST(PathDeviation, each_path_has_its_own_and_loose_bounds_show_in_the_ratio) {
  SmallPack pack = small_pack();
  for (const DrawableId id : {0u, 2u, 4u}) pack.skeleton.drawables[id].error = 1.5;
  const auto both = deviations(pack, {{above(100.5, 0.01)}, {above(100.5, 2), above(200.5, 2)}});
  EXPECT_EQ(both[0].drawables_simplified, 0u);
  EXPECT_EQ(both[0].bound_over_measured.p50, 0);
  EXPECT_NEAR(both[1].bound_over_measured.p50, 3, 1e-6);
  EXPECT_GT(both[1].pixels_max, 50 / 100.0);
}

TEST(PathDeviation, a_damaged_chunk_is_said_and_not_passed_over) {
  const auto file = write_pack(small_pack());
  const Pack pack(file);
  std::filesystem::resize_file(file, 64);
  EXPECT_THROW(measure_deviation(pack, std::vector<std::vector<FrameRequest>>{{above(100.5, 2)}}, 1000),
               std::runtime_error);
}

}  // namespace triptych
