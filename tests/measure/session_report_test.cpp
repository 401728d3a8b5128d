#include "measure/session_report.hpp"

#include "measure/frame_series.hpp"
#include "measure/session_faults.hpp"

#include <gtest/gtest.h>

namespace triptych {

namespace {

RoleRecord three_frames() {
  RoleRecord record;
  record.frames = {{.number = 0,
                    .frame_ms = 12.3456789,
                    .cut_drawables = 9,
                    .added = 2,
                    .removed = 0,
                    .visible_count = 2,
                    .visible = {0, 1}},
                   {.number = 1,
                    .frame_ms = 2,
                    .cut_drawables = 9,
                    .added = 0,
                    .removed = 0,
                    .visible_count = 2,
                    .visible = {0, 1}},
                   {.number = 2,
                    .frame_ms = 3,
                    .cut_drawables = 8,
                    .added = 1,
                    .removed = 1,
                    .visible_count = 2,
                    .visible = {0, 2}}};
  return record;
}

}  // namespace

TEST(SessionReport, deltas_save_what_did_not_change) {
  const nlohmann::json delta = delta_json({three_frames()});
  // 4 ids changed of 6 that were visible.
  EXPECT_NEAR(delta["saved_percent"].get<double>(), 100 * (1 - 4.0 / 6), 1e-9);
  EXPECT_NEAR(delta["added_mean"].get<double>(), 1, 1e-12);
  EXPECT_NEAR(delta["removed_mean"].get<double>(), 1.0 / 3, 1e-12);
}

TEST(SessionReport, bytes_an_id_count_what_every_role_sent) {
  RoleRecord render = three_frames(), cull;
  render.sockets = {{.name = "a", .bytes = 10, .messages = 1, .delta_body_bytes = 8, .delta_ids = 2}};
  cull.sockets = {{.name = "b", .bytes = 10, .messages = 1, .delta_body_bytes = 4, .delta_ids = 2}};
  EXPECT_DOUBLE_EQ(delta_json({render, cull})["body_bytes_per_id"].get<double>(), 3);
}

TEST(SessionReport, the_formula_is_the_papers) {
  // 8nf + nhf/b + 216f + 3hf bytes, n = 4000, f = 30, h = 50, b = 100: the 8.3 Mbit/s that the paper names.
  EXPECT_NEAR(formula_bits_per_second(4000, 30) / 1e6, 8.25, 0.01);
}

TEST(SessionReport, faults_say_what_went_when_and_when_it_was_back) {
  std::vector<FrameRecord> frames(10);
  for (size_t i = 0; i < frames.size(); ++i) {
    frames[i].number = static_cast<uint32_t>(100 + i);
    frames[i].frame_ms = 500;
    frames[i].fallback = (i >= 2 && i < 5) || i >= 8;
  }
  EXPECT_TRUE(faults_json({}).empty());
  frames[2].lost = "switch node 1 lost";
  frames[4].lost = "and again";
  frames[8].lost = "too late";
  const nlohmann::json faults = faults_json(frames);
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_EQ(faults[0], (nlohmann::json{{"frame", 102},
                                       {"second", 1.0},
                                       {"reason", "switch node 1 lost; and again"},
                                       {"frames_alone", 3},
                                       {"alone_ms", 1500.0},
                                       {"back_at_frame", 105}}));
  EXPECT_EQ(faults[1]["reason"], "too late");
  EXPECT_EQ(faults[1]["frames_alone"], 2);
  EXPECT_TRUE(faults[1]["back_at_frame"].is_null());
}

TEST(SessionReport, a_series_has_one_value_a_frame) {
  const nlohmann::json series = frame_series(three_frames().frames);
  EXPECT_EQ(series["frame_ms"], nlohmann::json({12.346, 2.0, 3.0}));
  EXPECT_EQ(series["visible"], nlohmann::json({2, 2, 2}));
  EXPECT_EQ(series["changed"], nlohmann::json({2, 0, 2}));
  EXPECT_EQ(series["cut"], nlohmann::json({9, 9, 8}));
}

}  // namespace triptych
