#include "measure/session_report.hpp"

#include "base/error.hpp"
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

TEST(RoleRecord, is_read_as_it_was_written) {
  RoleRecord record = three_frames();
  record.raster = "exact";
  record.sockets = {{.name = "a", .bytes = 10, .messages = 1}};
  EXPECT_EQ(to_json(role_record_from_json(to_json(record), "here")), to_json(record));
}

TEST(RoleRecord, of_another_build_is_named_with_both_versions) {
  const auto refused = [](const nlohmann::json& document) -> std::string {
    try {
      role_record_from_json(document, "switch 0");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  nlohmann::json document = to_json(three_frames());
  document["role_record"] = role_record_version + 1;
  document["sockets"] = "of another kind";
  EXPECT_EQ(refused(document),
            fmt::format("switch 0: is the record of a role of another build of the program: its "
                        "version is {}, this one needs {}",
                        role_record_version + 1, role_record_version));
  document.erase("role_record");
  EXPECT_NE(refused(document).find("its version is 0"), std::string::npos) << refused(document);
  EXPECT_EQ(refused(nlohmann::json::array()), "switch 0: is not the record of a role");
}

TEST(RoleRecord, its_version_goes_up_when_its_keys_change) {
  RoleRecord record = three_frames();
  record.frames.resize(1);
  record.sockets.resize(1);
  record.clocks.resize(1);
  record.timeline.spans.resize(1);
  std::string keys;
  const nlohmann::json flat = to_json(record).flatten();
  for (const auto& [key, value] : flat.items()) keys += key + " ";
  // Where these differ now, raise role_record_version and write the new ones down here.
  EXPECT_EQ(role_record_version, 6);
  EXPECT_EQ(keys,
            "/clocks/0/ahead_ms /clocks/0/peer /clocks/0/uncertainty_ms /cost_coefficients/0 "
            "/cost_coefficients/1 /cost_coefficients/2 /cost_coefficients/3 /cost_coefficients/4 "
            "/cost_coefficients/5 /device/renderer /device/vendor /device/version /frames/0/added "
            "/frames/0/camera_to_image_ms /frames/0/cut_drawables /frames/0/digest_mismatch "
            "/frames/0/drawn_triangles /frames/0/fallback /frames/0/frame_ms /frames/0/gets_finer "
            "/frames/0/hardware_cull_ms /frames/0/latency_known /frames/0/latency_network_ms "
            "/frames/0/latency_render_ms /frames/0/latency_waiting_ms /frames/0/left_out_drawables "
            "/frames/0/level_changes /frames/0/lost /frames/0/network_ms /frames/0/number "
            "/frames/0/occlusion_representation_ms /frames/0/owed_drawables /frames/0/picture_hash "
            "/frames/0/pixel_error /frames/0/raised_for_memory /frames/0/redrawn /frames/0/removed "
            "/frames/0/render_ms /frames/0/steered/aim_ms /frames/0/steered/asked_pixel_error "
            "/frames/0/steered/cost_ms /frames/0/steered/in_reach /frames/0/steered/pixel_error "
            "/frames/0/steered/predicted_ms /frames/0/steered/target_ms "
            "/frames/0/steered/undisturbed /frames/0/steered/wall_ms /frames/0/tests "
            "/frames/0/visible/0 /frames/0/visible/1 /frames/0/visible_count /frames/0/waiting_ms "
            "/memory/geometry/bytes /memory/geometry/cap /memory/geometry/evicted_chunks "
            "/memory/geometry/hits /memory/geometry/left_out /memory/geometry/loaded_chunks "
            "/memory/geometry/no_room /memory/geometry/peak_bytes /memory/geometry/read_bytes "
            "/memory/geometry/reloaded_chunks /memory/geometry/textures/bytes "
            "/memory/geometry/textures/cap /memory/geometry/textures/coarser_views "
            "/memory/geometry/textures/decoded_bytes /memory/geometry/textures/evicted "
            "/memory/geometry/textures/hits /memory/geometry/textures/misses "
            "/memory/geometry/textures/over_cap_views /memory/geometry/textures/peak_bytes "
            "/memory/geometry/textures/read_bytes /memory/geometry/textures/uploaded_bytes "
            "/memory/geometry/uploaded_bytes "
            "/memory/geometry/view_bytes /memory/geometry/wait_ms /memory/read_ahead/bytes "
            "/memory/read_ahead/dropped /memory/read_ahead/foreseen_read "
            "/memory/read_ahead/foreseen_taken /memory/read_ahead/in_time /memory/read_ahead/late "
            "/memory/read_ahead/open /memory/read_ahead/peak_bytes /memory/read_ahead/read_ahead "
            "/memory/read_ahead/reads /memory/read_ahead/taken /most_waiting/bytes "
            "/most_waiting/messages /peak_rss_bytes /raster /role_record /sockets/0/bytes "
            "/sockets/0/delta_body_bytes /sockets/0/delta_ids /sockets/0/deltas "
            "/sockets/0/kernel_bytes /sockets/0/least_round_trip_ms /sockets/0/messages "
            "/sockets/0/name /sockets/0/retransmissions /sockets/0/round_trip_ms /timeline/lost "
            "/timeline/process /timeline/spans/0/begin_ms /timeline/spans/0/end_ms "
            "/timeline/spans/0/frame /timeline/spans/0/stage ");
}

TEST(SessionReport, a_series_has_one_value_a_frame) {
  const nlohmann::json series = frame_series(three_frames().frames);
  EXPECT_EQ(series["frame_ms"], nlohmann::json({12.346, 2.0, 3.0}));
  EXPECT_EQ(series["visible"], nlohmann::json({2, 2, 2}));
  EXPECT_EQ(series["changed"], nlohmann::json({2, 0, 2}));
  EXPECT_EQ(series["cut"], nlohmann::json({9, 9, 8}));
}

}  // namespace triptych
