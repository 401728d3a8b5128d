// --target-ms: frames that are steered say so, and one that cannot be kept is never worse than its limit.
#include "tests/session/scene_files.hpp"

namespace triptych::test {
namespace {

class TargetTime : public SceneFiles {
 protected:
  std::vector<std::string> render(std::vector<std::string> more) const {
    return with(
        {"render", pack, "--path", path, "--size", "160x120", "--json", json, "-o", folder.file("pictures")},
        std::move(more));
  }
  /// What any run with a target must have.
  void expect_steered(const nlohmann::json& report, double target_ms, const char* cost) const {
    EXPECT_EQ(report.at("target_ms"), target_ms);
    const nlohmann::json& steering = report.at("steering");
    EXPECT_EQ(steering.at("cost"), cost);
    EXPECT_GT(steering.at("cost_ms").at("mean").get<double>(), 0);
    EXPECT_GE(steering.at("prediction_error").at("p95").get<double>(),
              steering.at("prediction_error").at("p50").get<double>());
    for (const auto& [term, milliseconds] : steering.at("coefficients_ms").items())
      EXPECT_GE(milliseconds.get<double>(), 0) << term;
    for (const char* key : {"pixel_error", "aim_ms", "cost_ms", "predicted_ms"})
      EXPECT_EQ(report.at("series").at(key).size(), frame_count) << key;
  }
};

TEST_F(TargetTime, a_target_that_nothing_keeps_is_drawn_at_the_largest_pixel_error_and_counted) {
  run(render({"--target-ms", "0.000001"}));
  const nlohmann::json report = json_of(json);
  expect_steered(report, 0.000001, "cpu_over_threads");
  for (const auto& pixel_error : report["series"]["pixel_error"]) EXPECT_EQ(pixel_error, 64);
  EXPECT_EQ(report["steering"]["out_of_reach_frames"], frame_count);
  EXPECT_EQ(report["steering"]["raised_frames"], frame_count);
  EXPECT_EQ(report["steering"]["share_within"], 0);
}

TEST_F(TargetTime, with_time_enough_pictures_are_those_without_a_target) {
  run(render({}));
  EXPECT_FALSE(json_of(json).contains("target_ms"));
  const std::string later = folder.file("pictures/000005.png"), without = text_of(later);
  run(render({"--target-ms", "1000000"}));
  const nlohmann::json report = json_of(json);
  expect_steered(report, 1000000, "cpu_over_threads");
  EXPECT_EQ(report["steering"]["raised_frames"], 0);
  EXPECT_EQ(report["steering"]["share_within"], 1);
  EXPECT_FALSE(without.empty());
  EXPECT_EQ(text_of(later), without);
}

TEST_F(TargetTime, a_session_s_frames_carry_the_raised_pixel_error_to_all_roles) {
  run(session({"--target-ms", "0.000001", "--json", json, "--timeout", "60000"}));
  const nlohmann::json report = json_of(json);
  expect_steered(report, 0.000001, "busiest_role");
  for (const auto& pixel_error : report["series"]["pixel_error"]) EXPECT_EQ(pixel_error, 64);
  EXPECT_EQ(report["digest_mismatches"], 0);
}

TEST_F(TargetTime, a_session_with_a_target_and_one_with_its_pixel_error_show_the_same_pictures) {
  run(session({"--target-ms", "0.000001", "--hash", "--json", json, "--timeout", "60000"}));
  const nlohmann::json steered = json_of(json).at("pictures");
  run(session({"--pixel-error", "64", "--hash", "--json", json, "--timeout", "60000"}));
  EXPECT_EQ(json_of(json).at("pictures"), steered);
}

TEST_F(TargetTime, what_makes_no_sense_with_a_target_is_a_usage_error) {
  for (const std::vector<std::string>& flags :
       {std::vector<std::string>{"--target-ms", "0"}, std::vector<std::string>{"--target-ms", "-3"},
        std::vector<std::string>{"--target-ms", "nan"}, std::vector<std::string>{"--target-ms", "inf"},
        std::vector<std::string>{"--target-ms", "5", "--pixel-error", "1,2"},
        std::vector<std::string>{"--target-ms", "5", "--full-detail"}}) {
    EXPECT_EQ(Program(render(flags)).wait(), 2) << flags.back();
  }
  EXPECT_EQ(Program(measure({"--target-ms", "5"})).wait(), 2) << "it compares at one pixel error";
}

}  // namespace
}  // namespace triptych::test
