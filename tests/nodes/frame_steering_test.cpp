// Steering on the device cpu: what it chooses between, and that it changes nothing but pixel errors.
#include "nodes/local_steering.hpp"
#include "raster/raster_device.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

constexpr int width = 96, height = 72;
constexpr double no_time = 1e-6, all_the_time = 1e9;  // milliseconds

class FrameSteeringTest : public testing::Test {
 protected:
  FrameSteeringTest() {
    for (const View& view : scenes::path(pack.skeleton(), width, height))
      frames.push_back({static_cast<uint32_t>(frames.size()), {view, 0.5}});
    frames.resize(12);
  }
  LocalPipeline pipeline() const { return {pack, {.width = width, .height = height}}; }

  const Pack& pack = scenes::pack("room");
  std::vector<FrameRequest> frames;
};

TEST_F(FrameSteeringTest, a_set_of_the_frame_s_own_cut_is_estimated_as_what_it_is) {
  LocalPipeline drawing = pipeline();
  const VisibleSet visible = drawing.draw(frames[0]).visible;
  ASSERT_GT(visible.size(), 0u);
  double triangles = 0;
  for (const DrawableId id : visible) triangles += pack.skeleton().drawables[id].triangles;
  WorkEstimator estimator(pack.skeleton());
  const FrameView view(pack.skeleton(), frames[0].state);
  const FrameWork before = estimator.estimate(view, visible);
  EXPECT_EQ(before.triangles, triangles);
  EXPECT_EQ(before.drawables, static_cast<double>(visible.size()));
  EXPECT_DOUBLE_EQ(before.megapixels, 1e-6 * width * height);
  EXPECT_GT(before.covered_megapixels, 0);
  EXPECT_LE(before.covered_megapixels, before.megapixels * before.drawables);
  EXPECT_GT(before.large_triangles, 0);
  EXPECT_LT(before.large_triangles, triangles);
  EXPECT_GT(before.new_triangles, 0);
  estimator.loaded(visible);
  EXPECT_EQ(estimator.estimate(view, visible).new_triangles, 0);
}

TEST_F(FrameSteeringTest, a_larger_pixel_error_is_estimated_as_less_work) {
  FrameState fine = frames[0].state, coarse = fine;
  fine.pixel_error = 0;
  coarse.pixel_error = max_raised_pixel_error;
  // All of the cut: what is hidden in it is in a coarse level too.
  const VisibleSet all = select_cut(FrameView(pack.skeleton(), fine)).drawables;
  WorkEstimator estimator(pack.skeleton());
  EXPECT_LT(estimator.estimate(FrameView(pack.skeleton(), coarse), all).triangles,
            estimator.estimate(FrameView(pack.skeleton(), fine), all).triangles);
}

TEST_F(FrameSteeringTest, with_time_enough_the_frames_are_those_of_the_pipeline_alone) {
  LocalPipeline alone = pipeline(), drawing = pipeline();
  LocalSteering steering(drawing, {.target_ms = all_the_time});
  for (FrameRequest& frame : frames) {
    const VisibleSet expected = alone.draw(frame).visible;
    const FrameRecord record = steering.draw(frame);
    EXPECT_EQ(frame.state.pixel_error, 0.5);
    EXPECT_EQ(record.visible, expected) << frame.number;
    EXPECT_EQ(drawing.target().read_colors(), alone.target().read_colors()) << frame.number;
    EXPECT_TRUE(record.steered.in_reach);
  }
}

TEST_F(FrameSteeringTest, without_time_the_frames_are_those_of_the_largest_pixel_error_and_say_so) {
  LocalPipeline alone = pipeline(), drawing = pipeline();
  LocalSteering steering(drawing, {.target_ms = no_time});
  for (FrameRequest& frame : frames) {
    const FrameRecord record = steering.draw(frame);
    EXPECT_EQ(frame.state.pixel_error, max_raised_pixel_error);
    EXPECT_EQ(record.visible, alone.draw(frame).visible) << "what is raised is part of the frame";
    EXPECT_EQ(drawing.target().read_colors(), alone.target().read_colors()) << frame.number;
    EXPECT_FALSE(record.steered.in_reach);
    EXPECT_EQ(record.steered.asked_pixel_error, 0.5);
    EXPECT_EQ(record.steered.pixel_error, max_raised_pixel_error);
    EXPECT_GT(record.steered.predicted_ms, 0);
    EXPECT_GT(record.steered.cost_ms, 0);
    EXPECT_GT(record.steered.wall_ms, 0);
  }
}

TEST_F(FrameSteeringTest, frames_in_flight_are_learnt_from_by_their_numbers) {
  FrameSteering steering(pack.skeleton(), {.target_ms = all_the_time});
  for (FrameRequest& frame : frames) steering.steer(frame);
  EXPECT_EQ(steering.drawn(1, {}, 5).cost_ms, 5);
  EXPECT_EQ(steering.drawn(0, {}, 5).target_ms, 0) << "an earlier one is forgotten";
  EXPECT_EQ(steering.drawn(99, {}, 5).target_ms, 0) << "one that was never steered";
}

TEST(CostMeasure, is_processor_time_unless_a_graphics_card_draws) {
  EXPECT_EQ(measure_of(raster_device_names()), CostMeasure::cpu_over_threads);
  EXPECT_EQ(measure_of({"NVIDIA Corporation", "NVIDIA H200/PCIe/SSE2", "4.6.0"}), CostMeasure::wall);
  EXPECT_EQ(measure_of({"Mesa", "llvmpipe (LLVM 15.0.6, 256 bits)", "4.5"}), CostMeasure::cpu_over_threads);
}

}  // namespace
}  // namespace triptych
