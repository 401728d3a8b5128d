// What a run with a target says of itself.
#include "measure/steering_report.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

/// A frame of a target of 10 ms.
FrameRecord frame(double pixel_error, double predicted_ms, double cost_ms, double wall_ms, bool undisturbed,
                  bool in_reach = true) {
  FrameRecord record;
  record.steered = {10, 1, pixel_error, 9, predicted_ms, cost_ms, wall_ms, undisturbed, in_reach};
  return record;
}

TEST(SteeringReport, counts_what_was_kept_raised_and_out_of_reach) {
  nlohmann::json report;
  const std::string line =
      add_steering(report,
                   {frame(1, 8, 10, 11, true), frame(2, 9, 12, 30, false), frame(4, 10, 12.5, 13, true),
                    frame(64, 15, 20, 20, false, false), FrameRecord{}},
                   10, "wall", {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(report["target_ms"], 10);
  EXPECT_EQ(report["pixel_error"]["max"], 64);
  EXPECT_EQ(report["series"]["pixel_error"], nlohmann::json({1.0, 2.0, 4.0, 64.0}));
  const nlohmann::json& steering = report["steering"];
  EXPECT_EQ(steering["share_within"], 0.5);
  EXPECT_EQ(steering["undisturbed_frames"], 2);
  EXPECT_EQ(steering["share_within_undisturbed_wall"], 0.5);
  EXPECT_EQ(steering["raised_frames"], 3);
  EXPECT_EQ(steering["out_of_reach_frames"], 1);
  EXPECT_EQ(steering["cost"], "wall");
  EXPECT_EQ(steering["coefficients_ms"]["triangles"], 3);
  EXPECT_DOUBLE_EQ(steering["prediction_error"]["max"].get<double>(), 0.25);
  EXPECT_NE(line.find("50.0 % of the frames cost at most 12 ms"), std::string::npos) << line;
  EXPECT_NE(line.find("1 would take longer at 64 pixels, too"), std::string::npos) << line;
}

TEST(SteeringReport, where_no_frame_was_undisturbed_there_is_no_share_of_them) {
  nlohmann::json report;
  add_steering(report, {frame(1, 8, 10, 11, false)}, 10, "wall", {});
  EXPECT_TRUE(report["steering"]["share_within_undisturbed_wall"].is_null());
}

}  // namespace
}  // namespace triptych
