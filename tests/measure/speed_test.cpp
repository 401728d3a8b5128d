#include "measure/speed.hpp"

#include "nodes/pack_device.hpp"
#include "render/context.hpp"
#include "tests/support/scenes.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace triptych {
namespace {

SpeedSeries series_of(const std::string& method, const std::string& device, const std::vector<double>& times,
                      const std::vector<uint64_t>& triangles = {}) {
  SpeedSeries series{.method = method, .device = device};
  for (size_t i = 0; i < times.size(); ++i) {
    series.frames.push_back({.frame_ms = times[i],
                             .drawn_triangles = i < triangles.size() ? triangles[i] : 0,
                             .stages = {{"draw", times[i] / 2}}});
  }
  return series;
}

TEST(SpeedRatios, are_medians_of_pairs_and_not_ratios_of_medians) {
  const nlohmann::json ratios =
      speed_ratios({series_of("triptych", "gl", {1, 10, 100}, {2, 9, 30}),
                    series_of("oracle", "gl", {10, 5, 80}, {1, 3, 10}), series_of("embree", "", {2, 4, 50}),
                    series_of("everything", "gl", {300, 300, 300})},
                   "gl");
  EXPECT_DOUBLE_EQ(ratios["triptych_over_oracle"].get<double>(), 1.25);  // of 0.1, 2, 1.25
  EXPECT_DOUBLE_EQ(ratios["triptych_over_embree"].get<double>(), 2);
  EXPECT_DOUBLE_EQ(ratios["everything_over_triptych"].get<double>(), 30);
  EXPECT_DOUBLE_EQ(ratios["triptych_triangles_over_oracle"].get<double>(), 3);
  EXPECT_DOUBLE_EQ(ratios["p95_over_median"].get<double>(), 10);
  for (const char* absent : {"triptych_over_frustum", "triptych_over_frustum_hidepth", "gl_over_cpu"})
    EXPECT_FALSE(ratios.contains(absent)) << absent;
}

TEST(SpeedRatios, are_of_the_device_that_is_asked_for) {
  const std::vector<SpeedSeries> series = {
      series_of("triptych", "gl", {8, 8}), series_of("frustum", "gl", {16, 16}),
      series_of("triptych", "cpu", {2, 2}), series_of("frustum", "cpu", {20, 20}),
      series_of("frustum-hidepth", "cpu", {4, 4})};
  EXPECT_DOUBLE_EQ(speed_ratios(series, "gl")["triptych_over_frustum"].get<double>(), 0.5);
  EXPECT_FALSE(speed_ratios(series, "gl").contains("triptych_over_frustum_hidepth"));
  const nlohmann::json cpu = speed_ratios(series, "cpu");
  EXPECT_DOUBLE_EQ(cpu["triptych_over_frustum"].get<double>(), 0.1);
  EXPECT_DOUBLE_EQ(cpu["triptych_over_frustum_hidepth"].get<double>(), 0.5);
  EXPECT_DOUBLE_EQ(cpu["gl_over_cpu"].get<double>(), 4);
}

class Speed : public testing::Test {
 protected:
  Speed() {
    for (const View& view : scenes::random_views(pack.skeleton(), 64, 48, 8, 3))
      frames.push_back({static_cast<uint32_t>(frames.size()), {view, 1}});
  }
  std::vector<SpeedSeries> measure(const SpeedOptions& options = {}) {
    const std::vector<SpeedDevice> devices = {{"gl", device.hierarchy(), device.device()},
                                              {"cpu", cpu.hierarchy(), cpu.device()}};
    return measure_speed(pack, devices, frames, options);
  }

  ChosenDevice chosen = choose_device({DeviceKind::gl});
  const Pack& pack = scenes::pack("room");
  PackDevice device{pack, chosen.options}, cpu{pack};
  std::vector<FrameRequest> frames;
};

TEST_F(Speed, each_method_has_every_frame_but_those_of_the_warm_up) {
  const std::vector<SpeedSeries> series = measure({.warm_up = 2});
  std::vector<std::string> names;
  for (const SpeedSeries& one : series) {
    names.push_back(one.method);
    ASSERT_EQ(one.frames.size(), 6u) << one.method;
    for (const SpeedSeries::Frame& frame : one.frames) {
      EXPECT_GT(frame.frame_ms, 0) << one.method;
      double stages = 0;
      for (const SpeedStage& stage : frame.stages) stages += stage.milliseconds;
      EXPECT_LE(stages, frame.frame_ms) << one.method;
    }
  }
  std::vector<std::string> all = speed_method_names();
  std::sort(all.begin(), all.end());
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());  // some on each device
  EXPECT_EQ(names, all);
  EXPECT_EQ(measure({.methods = {"oracle"}, .warm_up = 100}).front().frames.size(), 1u) << "one is left";
}

TEST_F(Speed, the_oracle_draws_no_more_than_triptych_and_that_no_more_than_the_frustum) {
  const std::vector<SpeedSeries> series =
      measure({.methods = {"oracle", "triptych", "frustum", "frustum-hidepth", "everything"}, .warm_up = 0});
  for (const SpeedDevice& on :
       {SpeedDevice{"gl", device.hierarchy(), device.device()}, {"cpu", cpu.hierarchy(), cpu.device()}}) {
    const auto triangles = [&](const std::string& method, size_t frame) {
      const auto found = std::find_if(series.begin(), series.end(), [&](const SpeedSeries& one) {
        return one.method == method && (one.device == on.name || method == "everything");
      });
      return found->frames[frame].drawn_triangles;
    };
    const std::vector<VisibleSet> owners = owners_of_frames(on, frames);
    uint64_t oracle = 0, frustum = 0;
    for (size_t i = 0; i < frames.size(); ++i) {
      uint64_t owned = 0;
      for (const DrawableId id : owners[i]) owned += pack.skeleton().drawables[id].triangles;
      EXPECT_EQ(triangles("oracle", i), owned);
      EXPECT_LE(owned, triangles("triptych", i));
      EXPECT_LE(triangles("triptych", i), triangles("frustum", i));
      if (on.name == "cpu") {
        EXPECT_LE(owned, triangles("frustum-hidepth", i));
        EXPECT_LE(triangles("frustum-hidepth", i), triangles("frustum", i));
      }
      EXPECT_LE(triangles("frustum", i), triangles("everything", i));
      oracle += owned;
      frustum += triangles("frustum", i);
    }
    EXPECT_GT(oracle, 0u) << on.name;
    EXPECT_LT(oracle, frustum) << "nothing is hidden in this scene";
  }
}

TEST_F(Speed, with_samples_the_oracle_draws_what_owns_any_of_them_and_triptych_all_of_that) {
  const SpeedDevice on{"cpu", cpu.hierarchy(), cpu.device()};
  const std::vector<VisibleSet> of_centers = owners_of_frames(on, frames);
  for (FrameRequest& frame : frames) frame.state.samples = 8;
  const std::vector<VisibleSet> owners = owners_of_frames(on, frames);
  const std::vector<SpeedSeries> series =
      measure({.methods = {"oracle", "triptych", "everything", "embree"}, .warm_up = 0});
  size_t more = 0;
  for (size_t i = 0; i < frames.size(); ++i) {
    uint64_t owned = 0;
    for (const DrawableId id : owners[i]) owned += pack.skeleton().drawables[id].triangles;
    for (const SpeedSeries& one : series) {
      if (one.method == "oracle" && one.device == "cpu") {
        EXPECT_EQ(one.frames[i].drawn_triangles, owned);
      }
      if (one.method == "triptych" && one.device == "cpu") {
        EXPECT_GE(one.frames[i].drawn_triangles, owned);
      }
    }
    more += owners[i].size();
    for (const DrawableId id : of_centers[i])
      more -= std::binary_search(owners[i].begin(), owners[i].end(), id);
  }
  EXPECT_GT(more, 0u) << "nothing owns samples alone";
}

TEST_F(Speed, what_opengl_would_draw_is_null_without_it_and_says_why) {
  const std::vector<SpeedDevice> devices = {{"cpu", cpu.hierarchy(), cpu.device()}};
  const nlohmann::json rows =
      speed_rows(measure_speed(pack, devices, frames, {.no_opengl = "EGL: none here"}));
  EXPECT_EQ(rows.size(), 6u);
  for (const nlohmann::json& row : rows) {
    const bool everything = row["method"] == "everything";
    EXPECT_EQ(row["frame_ms"].is_null(), everything) << row;
    EXPECT_EQ(row.value("why", ""), everything ? "EGL: none here" : "") << row;
  }
}

TEST_F(Speed, what_does_not_fit_into_memory_is_null_and_says_why) {
  const std::vector<SpeedSeries> series = measure({.max_memory_bytes = 1000});
  for (const nlohmann::json& row : speed_rows(series)) {
    const bool whole_model = row["method"] == "everything" || row["method"] == "embree";
    EXPECT_EQ(row["frame_ms"].is_null(), whole_model) << row;
    EXPECT_EQ(row.contains("why"), whole_model) << row;
  }
  const nlohmann::json ratios = speed_ratios(series, "gl");
  EXPECT_FALSE(ratios.contains("triptych_over_embree"));
  EXPECT_TRUE(ratios.contains("triptych_over_oracle"));
}

}  // namespace
}  // namespace triptych
