// The governor against synthetic frames, whose cost is a function of the pixel error.
#include "nodes/frame_governor.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <set>
#include <vector>

namespace triptych {
namespace {

/// A frame that costs `full` at one pixel, and half as much at twice the pixel error.
struct Scene {
  double full = 100;
  double at(double pixel_error) const { return full / pixel_error; }
};

GovernedFrame choose(FrameGovernor& governor, const Scene& scene, double asked = 1) {
  return governor.choose(asked, [&](double pixel_error) { return scene.at(pixel_error); });
}

TEST(FrameGovernor, what_has_time_keeps_the_asked_pixel_error) {
  FrameGovernor governor(10);
  for (int i = 0; i < 5; ++i) {
    const GovernedFrame frame = choose(governor, {9.9}, 1.5);
    EXPECT_EQ(frame.pixel_error, 1.5);
    EXPECT_TRUE(frame.in_reach);
  }
}

TEST(FrameGovernor, what_would_take_too_long_is_raised_at_once_and_no_further_than_it_must) {
  FrameGovernor governor(10);
  const GovernedFrame frame = choose(governor, {100});
  EXPECT_LE(frame.predicted_ms, 10);
  // One quarter of an octave finer would have exceeded 95 % of the target.
  EXPECT_GT(Scene{100}.at(frame.pixel_error / std::exp2(0.25)), 9.5 * 0.999);
}

TEST(FrameGovernor, the_pixel_error_returns_step_by_step_to_the_asked_one_and_never_below) {
  FrameGovernor governor(10);
  double before = choose(governor, {300}).pixel_error;
  for (int i = 0; i < 40; ++i) {
    const double now = choose(governor, {5}).pixel_error;
    EXPECT_GE(now, 1);
    EXPECT_LE(before / now, std::exp2(0.25) * 1.001);
    before = now;
  }
  EXPECT_EQ(before, 1);
}

TEST(FrameGovernor, costs_that_tremble_do_not_make_levels_flap) {
  FrameGovernor governor(10);
  std::set<double> chosen;
  for (int i = 0; i < 50; ++i) {
    const double pixel_error = choose(governor, {i % 2 == 0 ? 100.0 : 97.0}).pixel_error;
    if (i > 5) chosen.insert(pixel_error);
  }
  EXPECT_EQ(chosen.size(), 1u);
}

TEST(FrameGovernor, what_no_pixel_error_can_keep_gets_the_largest_and_says_so) {
  FrameGovernor governor(10);
  const GovernedFrame frame = choose(governor, {1e6});
  EXPECT_EQ(frame.pixel_error, max_raised_pixel_error);
  EXPECT_FALSE(frame.in_reach);
  const GovernedFrame coarse = choose(governor, {1e9}, 200);
  EXPECT_EQ(coarse.pixel_error, 200) << "the asked one is above the largest";
}

TEST(FrameGovernor, predictions_that_are_no_numbers_count_as_too_long) {
  FrameGovernor governor(10);
  for (const double prediction :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const GovernedFrame frame = governor.choose(1, [&](double) { return prediction; });
    EXPECT_EQ(frame.pixel_error, max_raised_pixel_error);
    EXPECT_FALSE(frame.in_reach);
  }
  EXPECT_EQ(governor.choose(1, [](double) { return 0.0; }).predicted_ms, 0);
}

TEST(FrameGovernor, learning_what_is_no_number_changes_nothing) {
  FrameGovernor governor(10);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double value : {nan, std::numeric_limits<double>::infinity(), 0.0, -1.0}) {
    governor.learn(value, 5);
    governor.learn(5, value);
  }
  EXPECT_EQ(governor.aim_ms(), 10);
}

TEST(FrameGovernor, nineteen_of_twenty_frames_keep_the_target_although_predictions_are_uncertain) {
  FrameGovernor governor(10);
  std::mt19937 generator(3);
  std::lognormal_distribution<double> error(0, 0.3);  // a 95th percentile of 1.64
  int within = 0;
  constexpr int warm_up = 300, frames = 4000;
  for (int i = 0; i < warm_up + frames; ++i) {
    const GovernedFrame frame = choose(governor, {100});
    const double took = frame.predicted_ms * error(generator);
    governor.learn(frame.predicted_ms, took);
    within += i >= warm_up && took <= 12;
  }
  EXPECT_GE(within, frames * 95 / 100);
  EXPECT_LT(governor.aim_ms(), 8);
  EXPECT_GT(governor.aim_ms(), 6);
}

TEST(FrameGovernor, short_frames_do_not_make_it_careful_however_uncertain_they_are) {
  FrameGovernor governor(10);
  for (int i = 0; i < 100; ++i) governor.learn(1, 3);
  EXPECT_EQ(governor.aim_ms(), 10);
}

TEST(FrameGovernor, certain_predictions_use_all_of_the_target) {
  FrameGovernor governor(10);
  for (int i = 0; i < 500; ++i) governor.learn(8, i % 2 == 0 ? 8 : 8.4);
  EXPECT_EQ(governor.aim_ms(), 10);
}

}  // namespace
}  // namespace triptych
