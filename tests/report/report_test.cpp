#include "report/report.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "report/goals.hpp"
#include "report/html.hpp"
#include "report/report_page.hpp"

#include <gtest/gtest.h>

namespace triptych {

namespace {

using nlohmann::json;

json spread_of(double value) {
  return {{"mean", value}, {"p50", value}, {"p95", value}, {"p99", value}, {"max", value}};
}

json run_figures(double median_ms, double triangles) {
  return {{"frames", 3},
          {"frame_ms", spread_of(median_ms)},
          {"drawn_triangles", spread_of(triangles)},
          {"visible", spread_of(40)},
          {"cut", spread_of(400)}};
}

json walk_figures() {
  json stages = json::object();
  for (const char* name : {"occlusion_representation", "hardware_cull", "render", "network", "waiting"}) {
    stages[name] = spread_of(4);
  }
  const json series = {{"frame_ms", {50, 40, 45}},
                       {"cut", {400, 401, 402}},
                       {"visible", {40, 41, 42}},
                       {"changed", {40, 1, 2}}};
  json walk = run_figures(45, 30000);
  walk.update(
      {{"size", "512x512"},
       {"frames_compared", 3},
       {"identical_frames", 3},
       {"missing_drawables", 0},
       {"digest_mismatches", 0},
       {"fallback_frames", 0},
       {"culling_efficiency", 2.5},
       {"delta",
        {{"added_mean", 1}, {"removed_mean", 1}, {"saved_percent", 95.5}, {"body_bytes_per_id", 1.5}}},
       {"mbit_per_s", {{"measured", 0.2}, {"formula", 0.1}}},
       {"bytes_per_frame", {{"switch node 0 to render node, nodes", 90.5}}},
       {"traffic",
        {{"sockets",
          {{{"socket", "switch node 0 to render node, nodes channel"},
            {"bytes_per_frame", 90.5},
            {"formula_bytes_per_frame", 20.25},
            {"kernel_bytes_per_frame", 91.5},
            {"retransmissions", 0},
            {"round_trip_ms", 0.05}}}},
         {"receivers",
          {{{"receiver", "render node"}, {"bytes_per_frame", 181.0}, {"formula_bytes_per_frame", 160.5}}}},
         {"bytes_per_frame", 544},
         {"formula_bytes_per_frame", 430},
         {"formula_bytes_per_frame_whole_sets", 1400},
         {"kernel_bytes_per_frame", 545},
         {"retransmissions", 0},
         {"share_of_formula", 1.26},
         {"share_of_formula_whole_sets", 0.39},
         {"share_of_4_bytes_per_id", {{"bodies", 0.336}, {"bodies_and_headers", 1.5}}}}},
       {"latency_ms",
        {{"frames", 2},
         {"whole", spread_of(40)},
         {"occlusion_representation", spread_of(10)},
         {"hardware_cull", spread_of(8)},
         {"network", spread_of(1)},
         {"render", spread_of(15)},
         {"waiting", spread_of(5.5)},
         {"remainder", spread_of(0.5)}}},
       {"predicted_fps_three_machines", 31.5},
       {"stages_ms", stages},
       {"series", series},
       {"device", "gl"},
       {"gl", {{"renderer", "a renderer"}, {"version", "4.5"}}},
       {"one_process",
        {{"frames_compared", 3},
         {"identical_frames", 3},
         {"culling_efficiency", 2.5},
         {"stages_ms", stages},
         {"series", series}}}});
  return walk;
}

/// A folder with a whole run's files, which a test then spoils.
class ReportFiles : public testing::Test {
 protected:
  ReportFiles()
      : folder(std::filesystem::temp_directory_path() /
               (std::string("triptych_report_") +
                testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::remove_all(folder);
    add("walk", walk_figures());
    add("one_process", run_figures(40, 30000));
    add("coarse", run_figures(20, 9000));
    add("full_detail", run_figures(2000, 11000000));
    write_file(folder / "000000.png", "a picture");
    manifest["pictures"] = {
        {{"file", "000000.png"}, {"caption", "frame 0"}, {"command", "triptych draw --it"}}};
  }
  ~ReportFiles() override { std::filesystem::remove_all(folder); }

  void add(const std::string& name, const json& figures) {
    make_folder(folder);
    write_file(folder / (name + ".json"), figures.dump());
    manifest["entries"].push_back(
        {{"name", name}, {"command", "triptych " + name + " <scene> & more"}, {"json", name + ".json"}});
  }
  void change(const std::string& name, const json& figures) {
    write_file(folder / (name + ".json"), figures.dump());
  }
  Report load() {
    write_file(folder / "manifest.json", manifest.dump());
    return load_report(folder / "manifest.json");
  }
  /// What is said about a report that cannot be made; empty where it can.
  std::string complaint() {
    try {
      report_page(load());
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder;
  json manifest = {{"title", "A run"}, {"entries", json::array()}};
};

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(ReportFiles, says_what_drew) {
  EXPECT_NE(report_page(load()).find("a renderer, 4.5"), std::string::npos);
  json walk = walk_figures();
  walk["device"] = "cpu";
  walk.erase("gl");
  change("walk", walk);
  EXPECT_EQ(complaint(), "");
  EXPECT_NE(report_page(load()).find("by the program itself"), std::string::npos);
}

TEST_F(ReportFiles, says_when_where_and_by_what_it_was_made) {
  Report report = load();
  report.origin = {
      .date = "2026-03-01 14:05 UTC",
      .version = "1.2.3, commit abc",
      .machine = {.processor = "Some <processor>", .cores = 2, .memory_bytes = uint64_t{3} << 30}};
  EXPECT_TRUE(
      holds(report_page(report),
            "Made on 2026-03-01 14:05 UTC on Some &lt;processor&gt;, 2 cores, 3.0 GiB of memory, by triptych "
            "1.2.3, commit abc"));
  EXPECT_EQ(report_json(report)["made"]["cores"], 2);
  EXPECT_GE(this_machine().cores, 1u);
  EXPECT_GT(this_machine().memory_bytes, uint64_t{1} << 26);
  EXPECT_EQ(date_now().size(), report.origin.date.size());
}

TEST_F(ReportFiles, has_copies_of_its_pictures_so_that_its_folder_can_be_moved) {
  make_folder(folder / "pictures");
  write_file(folder / "pictures/000000.png", "another picture");
  manifest["pictures"].push_back({{"file", "pictures/000000.png"}, {"caption", "c"}, {"command", "d"}});
  Report report = load();
  name_pictures_beside_page(report);
  copy_pictures(report, folder / "page");
  std::filesystem::rename(folder / "page", folder / "moved");
  std::filesystem::remove_all(folder / "pictures");
  const std::string page = report_page(report);
  for (const auto& [name, text] : {std::pair{"report-pictures/1-000000.png", "a picture"},
                                   {"report-pictures/2-000000.png", "another picture"}}) {
    EXPECT_TRUE(holds(page, "src=\"" + std::string(name) + "\""));
    EXPECT_EQ(read_text_file(folder / "moved" / name), text);
  }
}

TEST_F(ReportFiles, captions_say_where_the_eye_is) {
  write_file(
      folder / "walk_path.json",
      R"({"triptych_path": 1, "frames": [{"eye": [1.5, 1.6, -20], "target": [0, 1, 0], "up": [0, 1, 0]}]})");
  manifest["pictures"][0].update({{"path", "walk_path.json"}, {"frame", 0}});
  EXPECT_TRUE(
      holds(report_page(load()),
            "frame 0; frame 0 of walk_path.json, eye at 1.50, 1.60, -20.00, looking at 0.00, 1.00, 0.00"));
  manifest["pictures"][0]["frame"] = 1;
  EXPECT_TRUE(holds(complaint(), "walk_path.json: has no frame 1: it has 1")) << complaint();
  manifest["pictures"][0]["frame"] = -1;
  EXPECT_TRUE(holds(complaint(), "has no whole number \"frame\"")) << complaint();
}

TEST_F(ReportFiles, the_page_holds_every_command_and_picture) {
  const std::string page = report_page(load());
  for (const char* name : {"walk", "one_process", "coarse", "full_detail"}) {
    EXPECT_TRUE(holds(page, "<code>triptych " + std::string(name) + " &lt;scene&gt; &amp; more</code>"))
        << name;
  }
  EXPECT_TRUE(holds(page, "<code>triptych draw --it</code>"));
  EXPECT_TRUE(holds(page, "<img src=\"000000.png\""));
}

TEST_F(ReportFiles, the_note_stands_on_the_page_where_there_is_one) {
  manifest["note"] = "one < two";
  EXPECT_TRUE(holds(report_page(load()), "<p>one &lt; two</p>"));
}

TEST_F(ReportFiles, the_page_loads_nothing_from_elsewhere) {
  const std::string page = report_page(load());
  for (const char* part : {"http:", "https:", "<script", "<link", "@import", "url("})
    EXPECT_FALSE(holds(page, part)) << part;
}

TEST_F(ReportFiles, a_run_that_reaches_everything_misses_nothing) {
  const Report report = load();
  const json merged = report_json(report);
  EXPECT_EQ(merged["targets"].size(), 10u);
  EXPECT_TRUE(merged["all_met"].get<bool>());
  EXPECT_FALSE(holds(report_page(report), "class=\"missed\""));
}

TEST_F(ReportFiles, a_missed_target_is_shown_as_missed_and_by_how_much) {
  json walk = walk_figures();
  walk["delta"]["saved_percent"] = 88.8;
  walk["identical_frames"] = 2;
  change("walk", walk);
  const Report report = load();
  const std::string page = report_page(report);
  EXPECT_TRUE(holds(page, "<span class=\"missed\">missed by 4.2: 88.8, at least 93.0</span>"));
  EXPECT_TRUE(holds(page, "<span class=\"missed\">missed by 1: 2, at least 3</span>"));
  EXPECT_TRUE(holds(page, "Targets: 8 of 10 met"));
  EXPECT_FALSE(report_json(report)["all_met"].get<bool>());
}

TEST_F(ReportFiles, a_run_that_targets_are_not_set_for_is_held_to_exactness_alone) {
  json walk = walk_figures();
  walk["delta"]["saved_percent"] = 88.8;
  change("walk", walk);
  manifest["held_to"] = "exactness";
  const std::string page = report_page(load());
  EXPECT_TRUE(holds(page, "not held to: 88.8 (at least 93.0)"));
  EXPECT_TRUE(holds(page, "Targets: 4 of 4 met, 6 not held to"));
  EXPECT_FALSE(holds(page, "class=\"missed\""));
  EXPECT_TRUE(report_json(load())["all_met"].get<bool>());
  walk["identical_frames"] = 2;
  change("walk", walk);
  EXPECT_TRUE(holds(report_page(load()), "Targets: 3 of 4 met, 6 not held to"));
  EXPECT_FALSE(report_json(load())["all_met"].get<bool>());
}

TEST_F(ReportFiles, the_page_shows_traffic_by_socket_and_latency_by_stage) {
  json walk = walk_figures();
  walk["batches"] = {{{"batch", 77},
                      {"bytes_per_frame", 500},
                      {"packets_per_frame", 1.5},
                      {"camera_to_image_ms", spread_of(41)},
                      {"frame_ms", spread_of(21)}}};
  walk["batches"].push_back(walk["batches"][0]);
  walk["restarts"] = 3;
  change("walk", walk);
  const std::string page = report_page(load());
  EXPECT_TRUE(holds(page, "switch node 0 to render node, nodes channel"));
  EXPECT_TRUE(holds(page, "all to the render node"));
  EXPECT_TRUE(holds(page, "39.0&nbsp;%"));  // of the formula at whole sets
  EXPECT_TRUE(holds(page, "camera to image"));
  EXPECT_TRUE(holds(page, "1.25&nbsp;% of the whole"));  // half a millisecond of 40 is left over
  EXPECT_TRUE(holds(page, "<td>77</td>") || holds(page, ">77<"));
  EXPECT_TRUE(holds(page, "Faults and recovery"));
}

TEST_F(ReportFiles, the_page_tells_each_fault_and_when_it_was_mended) {
  EXPECT_FALSE(holds(report_page(load()), "all three again")) << "nothing went wrong";
  json walk = walk_figures();
  walk["faults"] = {{{"frame", 1234},
                     {"second", 5.678},
                     {"reason", "switch node 1 lost: <closed>"},
                     {"frames_alone", 56},
                     {"alone_ms", 789.1},
                     {"back_at_frame", 1290}},
                    {{"frame", 2345},
                     {"second", 6},
                     {"reason", "too late"},
                     {"frames_alone", 1},
                     {"alone_ms", 2},
                     {"back_at_frame", nullptr}}};
  change("walk", walk);
  const std::string page = report_page(load());
  const std::vector<std::string> parts = {"switch node 1 lost: &lt;closed&gt;",
                                          grouped(1234),
                                          "5.68",
                                          ">56<",
                                          ">789<",
                                          grouped(1290),
                                          "too late",
                                          grouped(2345)};
  for (const std::string& part : parts) EXPECT_TRUE(holds(page, part)) << part;
}

TEST_F(ReportFiles, targets_follow_the_figures_of_their_runs) {
  change("full_detail", run_figures(399, 11000000));  // 40 ms are more than a tenth
  change("coarse", run_figures(20, 15000.5));         // more than half of 30,000
  size_t missed = 0;
  for (const Goal& goal : judge(load())) missed += !goal.met();
  EXPECT_EQ(missed, 2u);
}

TEST(Goal, what_is_missed_by_a_hair_does_not_read_as_missed_by_nothing) {
  const Goal goal{.what = "share", .value = 0.1002, .limit = 0.1, .decimals = 3, .entries = {}};
  EXPECT_EQ(goal.verdict(), "missed by 0.0002000: 0.100, at most 0.100");
}

TEST_F(ReportFiles, the_merged_json_holds_every_figure_beside_its_command) {
  const json merged = report_json(load());
  ASSERT_EQ(merged["entries"].size(), 4u);
  EXPECT_EQ(merged["entries"][0]["figures"], walk_figures());
  EXPECT_EQ(merged["entries"][0]["command"], "triptych walk <scene> & more");
}

TEST_F(ReportFiles, a_report_of_fewer_runs_leaves_out_what_it_cannot_know) {
  manifest["entries"].erase(0);
  const Report report = load();
  EXPECT_EQ(judge(report).size(), 2u);
  EXPECT_FALSE(holds(report_page(report), "Stages"));
}

TEST_F(ReportFiles, what_is_missing_or_broken_is_named_once) {
  change("coarse", {{"frames", 3}});
  EXPECT_EQ(complaint(), (folder / "coarse.json").string() + ": has no number at /drawn_triangles/mean");
  write_file(folder / "coarse.json", "{\"frames\": ");
  EXPECT_TRUE(holds(complaint(), (folder / "coarse.json").string() + ": line 1, column 12: is no JSON"));
  write_file(folder / "coarse.json", "[1, 2]");
  EXPECT_EQ(complaint(), (folder / "coarse.json").string() + ": does not hold a JSON object");
  std::filesystem::remove(folder / "coarse.json");
  EXPECT_TRUE(holds(complaint(), "coarse.json"));
}

TEST_F(ReportFiles, a_picture_that_is_not_there_is_named) {
  std::filesystem::remove(folder / "000000.png");
  EXPECT_EQ(complaint(), (folder / "000000.png").string() + ": is not there");
}

TEST_F(ReportFiles, a_manifest_that_makes_no_sense_is_refused) {
  const std::string place = (folder / "manifest.json").string();
  manifest["entries"].push_back(manifest["entries"][0]);
  EXPECT_EQ(complaint(), place + ": names \"walk\" twice");
  manifest["entries"] = "walk";
  EXPECT_EQ(complaint(), place + ": \"entries\" is not a list");
  manifest["entries"] = json::array({3});
  EXPECT_EQ(complaint(), place + ": has no text \"name\"");
  manifest["entries"] = json::array();
  EXPECT_EQ(complaint(), place + ": names no entries");
  manifest["held_to"] = "nothing";
  EXPECT_TRUE(holds(complaint(), "\"held_to\""));
}

TEST_F(ReportFiles, a_key_that_is_not_known_is_named_with_its_place) {
  manifest["entries"][0]["jason"] = "walk.json";
  EXPECT_TRUE(holds(complaint(), "manifest.json: entry walk: \"jason\" is not known")) << complaint();
  manifest["entries"][0].erase("jason");
  manifest["picture"] = manifest["pictures"];
  EXPECT_TRUE(holds(complaint(), "manifest.json: \"picture\" is not known")) << complaint();
}

}  // namespace

}  // namespace triptych
