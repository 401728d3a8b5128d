// How well costs are predicted, told apart from how well they can be.
#include "measure/prediction_trial.hpp"

#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

TriedFrame tried(double predicted_ms, double cost_ms, std::vector<double> again_ms,
                 double new_triangles = 0) {
  TriedFrame frame;
  frame.steered.predicted_ms = predicted_ms;
  frame.steered.cost_ms = cost_ms;
  frame.work.new_triangles = new_triangles;
  frame.steering_ms = 1;
  frame.again_ms = std::move(again_ms);
  return frame;
}

TEST(PredictionTrial, compares_with_the_median_and_counts_frames_that_read_apart) {
  nlohmann::json report;
  const std::string said = add_predictions(
      report, {tried(10, 20, {8, 9, 40}), tried(15, 10, {9, 9, 9}), tried(30, 20, {1, 1, 1}, 100)});
  EXPECT_EQ(report["frames"], 3);
  EXPECT_EQ(report["loading_frames"], 1);
  const nlohmann::json& errors = report["prediction_error"];
  EXPECT_DOUBLE_EQ(errors["of_one_drawing"]["max"].get<double>(), 0.5);
  EXPECT_DOUBLE_EQ(errors["of_the_median"]["max"].get<double>(), 0.5) << "the second frame's: 15 of 1 + 9";
  EXPECT_DOUBLE_EQ(errors["of_the_median"]["share_within_10_percent"].get<double>(), 0.5);
  EXPECT_DOUBLE_EQ(errors["of_loading_frames"]["max"].get<double>(), 0.5) << "of what it cost with reading";
  EXPECT_DOUBLE_EQ(report["noise"]["max"].get<double>(), 1) << "20 ms of a frame that takes 10";
  EXPECT_EQ(report["series"]["settled_ms"], nlohmann::json({10.0, 10.0, 2.0}));
  EXPECT_EQ(report["series"]["work"]["new_triangles"], nlohmann::json({0.0, 0.0, 100.0}));
  EXPECT_NE(said.find("1 frames that read chunks: off by 50 %"), std::string::npos) << said;
}

TEST(PredictionTrial, tells_frames_apart_that_take_much_of_the_target) {
  std::vector<TriedFrame> frames = {tried(1, 1, {0, 0, 0}), tried(15, 10, {9, 9, 9})};
  for (TriedFrame& frame : frames) frame.steered.target_ms = 12;
  frames.front().steered.predicted_ms = 3;
  nlohmann::json report;
  add_predictions(report, frames);
  EXPECT_EQ(report["relevant_frames"], 1);
  EXPECT_DOUBLE_EQ(report["prediction_error"]["of_the_median"]["max"].get<double>(), 2);
  EXPECT_DOUBLE_EQ(report["prediction_error"]["of_relevant_frames"]["max"].get<double>(), 0.5);
  EXPECT_DOUBLE_EQ(report["noise_of_relevant_frames"]["max"].get<double>(), 0);
}

TEST(PredictionTrial, of_no_frame_has_no_errors) {
  nlohmann::json report;
  add_predictions(report, {});
  EXPECT_TRUE(report["prediction_error"]["of_the_median"].is_null());
  EXPECT_TRUE(report["noise"].is_null());
  EXPECT_TRUE(report["prediction_error"]["of_relevant_frames"].is_null());
}

TEST(PredictionTrial, draws_frames_again_and_leaves_those_behind_them_as_they_are) {
  constexpr int width = 96, height = 72;
  const Pack& pack = scenes::pack("room");
  std::vector<FrameRequest> frames;
  for (const View& view : scenes::path(pack.skeleton(), width, height))
    frames.push_back({static_cast<uint32_t>(frames.size()), {view, 0.5}});
  frames.resize(8);
  LocalPipeline alone(pack, {.width = width, .height = height}),
      drawing(pack, {.width = width, .height = height});
  for (const FrameRequest& frame : frames) alone.draw(frame);
  FrameSteering steering(pack.skeleton(), {.target_ms = 1e9});
  const std::vector<TriedFrame> all = try_predictions(drawing, steering, frames, 3);
  ASSERT_EQ(all.size(), frames.size());
  EXPECT_EQ(drawing.target().read_colors(), alone.target().read_colors());
  for (const TriedFrame& frame : all) {
    EXPECT_EQ(frame.again_ms.size(), 3u);
    EXPECT_GT(frame.settled_ms(), 0);
    EXPECT_GT(frame.steered.cost_ms, frame.steering_ms);
    EXPECT_GT(frame.work.triangles + frame.work.megapixels, 0);
  }
}

}  // namespace
}  // namespace triptych
