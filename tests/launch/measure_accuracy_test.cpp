// `measure accuracy` as scripts use it.
#include "tests/session/program.hpp"
#include "tests/support/small_pack.hpp"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <set>

namespace triptych::test {
namespace {

class MeasureAccuracy : public testing::Test {
 protected:
  MeasureAccuracy() {
    nlohmann::json frames = nlohmann::json::array();
    for (int i = 0; i < 4; ++i)
      frames.push_back({{"eye", {20 + i, 5, 60}}, {"target", {20 + i, 5, 0}}, {"up", {0, 1, 0}}});
    std::ofstream(path) << nlohmann::json{{"triptych_path", 1}, {"fov_y_degrees", 60}, {"frames", frames}};
  }
  std::vector<std::string> words(const std::string& pack, const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"measure", "accuracy", pack,     "--path", path,
                                      "-o",      output,     "--json", json};
    if (std::count(more.begin(), more.end(), "--sizes") == 0) words.insert(words.end(), {"--size", "65x47"});
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  Folder folder;
  const std::string path = folder.file("path.json"), output = folder.file("accuracy"),
                    json = folder.file("out.json");
};

TEST_F(MeasureAccuracy, writes_a_row_a_setting_as_json_and_csv_and_a_report_with_its_pictures) {
  const std::string pack = write_pack(small_pack());
  run(words(pack, {"--pixel-error", "0.1,2", "--sizes", "65x47,33x21", "--compare", "2"}));
  const nlohmann::json report = json_of(json);
  EXPECT_EQ(report["violations"], 0);
  EXPECT_EQ(report["frames"], 4);
  std::set<std::string> settings;
  for (const nlohmann::json& row : report["rows"]) {
    settings.insert(row["strategy"].get<std::string>() + row["size"].get<std::string>() +
                    row["pixel_error"].dump() + row["min_pixels"].dump());
    EXPECT_EQ(row["compared_frames"], 2);
    for (const char* key : {"wrong_pixel_share", "hole_share", "swap_share", "popping", "rmse", "ssim",
                            "missed_triangle_share", "untraced_share"})
      EXPECT_TRUE(row[key].is_number()) << key;
    EXPECT_EQ(row["cover_kept"].is_number(), row["cover_pixels"].get<double>() > 0) << row;
    EXPECT_LE(row["deviation_px"]["max"].get<double>(), row["pixel_error"].get<double>());
    EXPECT_LE(row["deviation_px"]["median"].get<double>(), row["deviation_px"]["p99"].get<double>());
    if (row["pixel_error"] == 0.1 && !row.contains("may_miss")) {
      EXPECT_EQ(row["wrong_pixel_share"], 0) << row;
    }
  }
  EXPECT_EQ(settings.size(), report["rows"].size());
  EXPECT_GE(settings.size(), 12u);
  EXPECT_EQ(json_of(output + "/accuracy.json"), report);
  const std::string csv = text_of(output + "/accuracy.csv"), page = text_of(output + "/report.html");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), static_cast<std::ptrdiff_t>(report["rows"].size()) + 1);
  EXPECT_EQ(csv.find("pack,strategy,"), 0u);
  for (const nlohmann::json& item : report["strip"]) {
    const std::string file = item["file"].get<std::string>();
    EXPECT_NE(page.find(file), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(output + "/" + file)) << file;
  }
}

TEST_F(MeasureAccuracy, numbers_of_samples_are_rows_like_sizes_and_series_of_the_report) {
  const std::string pack = write_pack(small_pack());
  run(words(pack, {"--pixel-error", "2", "--strategies", "occlusion", "--samples", "1,4,4"}));
  const nlohmann::json rows = json_of(json)["rows"];
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0]["samples"], 1);
  EXPECT_EQ(rows[1]["samples"], 4);
  const std::string csv = text_of(output + "/accuracy.csv"), page = text_of(output + "/report.html");
  EXPECT_NE(csv.find(",size,samples,pixel_error,"), std::string::npos) << csv;
  EXPECT_NE(page.find("occlusion, 1 sample a pixel"), std::string::npos);
  EXPECT_NE(page.find("occlusion, 4 samples a pixel"), std::string::npos);
}

TEST_F(MeasureAccuracy, every_so_many_frames_of_the_path_are_said_in_the_report) {
  const std::string pack = write_pack(small_pack());
  Program program(words(pack, {"--every", "3", "--pixel-error", "2", "--compare", "9"}));
  EXPECT_EQ(program.wait(), 0);
  EXPECT_NE(program.errors().find("--compare 9: there are 2 frames"), std::string::npos) << program.errors();
  const nlohmann::json report = json_of(json);
  EXPECT_EQ(report["frames"], 2);
  EXPECT_EQ(report["path_frames"], 4);
  EXPECT_EQ(report["every"], 3);
  EXPECT_EQ(report["frames_say"], "frames 0 to 3 of 4, every 3rd");
  EXPECT_NE(text_of(output + "/report.html").find("frames 0 to 3 of 4, every 3rd"), std::string::npos);
  EXPECT_TRUE(report["rows"][0]["popping"].is_null()) << "frames 0 and 3 do not follow each other";
}

TEST_F(MeasureAccuracy, packs_of_one_name_are_told_apart_by_their_folders_and_one_pack_is_measured_once) {
  std::filesystem::create_directories(folder.file("x"));
  std::filesystem::create_directories(folder.file("y"));
  const std::string one = folder.file("x/m.tpk"), other = folder.file("y/m.tpk");
  std::filesystem::copy_file(write_pack(small_pack()), one);
  std::filesystem::copy_file(one, other);
  run(words(one, {"--pixel-error", "2", "--with", other, "--strategies", "occlusion"}));
  EXPECT_EQ(json_of(json)["rows"][0]["pack"], "x/m.tpk");
  EXPECT_EQ(json_of(json)["rows"][1]["pack"], "y/m.tpk");
  EXPECT_EQ(json_of(json)["advice"].size(), 2u);
  std::filesystem::create_symlink(one, folder.file("link.tpk"));
  EXPECT_NE(failure(words(one, {"--with", folder.file("link.tpk")})).find("link.tpk: is the same pack as "),
            std::string::npos);
}

TEST_F(MeasureAccuracy, an_earlier_run_s_pictures_go_and_a_run_that_fails_leaves_no_folder) {
  const std::string pack = write_pack(small_pack());
  SmallPack larger = small_pack();
  larger.skeleton.source_triangles = 257;
  const std::string other = folder.file("other.tpk");
  std::filesystem::copy_file(pack, folder.file("pack.tpk"));
  std::filesystem::copy_file(write_pack(larger), other);
  failure(words(folder.file("pack.tpk"), {"--with", other}));
  EXPECT_FALSE(std::filesystem::exists(output));
  std::filesystem::create_directories(output + "/pictures");
  for (const char* name : {"hole-99-shown.png", "0.125px-difference.png", "mine.png"})
    std::ofstream(output + "/pictures/" + name) << "x";
  run(words(folder.file("pack.tpk"), {"--pixel-error", "2", "--strategies", "occlusion"}));
  EXPECT_FALSE(std::filesystem::exists(output + "/pictures/hole-99-shown.png"));
  EXPECT_FALSE(std::filesystem::exists(output + "/pictures/0.125px-difference.png"));
  EXPECT_TRUE(std::filesystem::exists(output + "/pictures/mine.png"));
  EXPECT_TRUE(std::filesystem::exists(output + "/pictures/2px.png"));
}

TEST_F(MeasureAccuracy, packs_of_one_model_stand_side_by_side_and_those_of_another_are_refused) {
  const std::string pack = write_pack(small_pack());
  const std::string other = folder.file("other.tpk");
  std::filesystem::copy_file(pack, other);
  run(words(pack, {"--pixel-error", "2", "--with", other, "--strategies", "occlusion"}));
  EXPECT_EQ(json_of(json)["rows"].size(), 2u);
  SmallPack larger = small_pack();
  larger.skeleton.source_triangles = 257;
  std::filesystem::rename(write_pack(larger), other);
  const std::string again = write_pack(small_pack());
  EXPECT_NE(
      failure(words(again, {"--with", other})).find("other.tpk: is a pack of another model: 257 source"),
      std::string::npos);
}

TEST_F(MeasureAccuracy, a_bound_that_promises_too_much_ends_with_exit_code_1_and_its_place) {
  SmallPack small = small_pack();
  for (const DrawableId id : {0u, 2u, 4u}) small.skeleton.drawables[id].error = 0.05;
  const std::string message = failure(words(write_pack(small), {"--pixel-error", "0.1"}));
  EXPECT_NE(message.find("promises were broken"), std::string::npos) << message;
  const nlohmann::json report = json_of(json);
  EXPECT_GT(report["violations"], 0);
  EXPECT_EQ(report["violated"][0]["place"].size(), 3u);
  EXPECT_GT(report["violated"][0]["pixels"].get<double>(), 0.1);
}

/// A wavy sphere of radius 10, as an object for each of so many sectors, which share no points.
void write_sphere(const std::string& file, int sectors, int rings) {
  std::ofstream obj(file);
  constexpr double pi = 3.14159265358979;
  int first = 1;
  for (int sector = 0; sector < sectors; ++sector) {
    obj << "o sector_" << sector << "\n";
    const int columns = 2 * rings / sectors;
    for (int i = 0; i <= rings; ++i) {
      for (int k = 0; k <= columns; ++k) {
        // The seam of the last sector is that of the first one, to the bit.
        const double around = 2 * pi * ((sector * columns + k) % (2 * rings)) / (2 * rings);
        const double down = pi * i / rings;
        const double r = 10 * (1 + 0.05 * std::sin(9 * down) * std::sin(6 * around));
        obj << "v " << r * std::sin(down) * std::cos(around) << " " << r * std::cos(down) << " "
            << r * std::sin(down) * std::sin(around) << "\n";
      }
    }
    for (int i = 0; i < rings; ++i) {
      for (int k = 0; k < columns; ++k) {
        const int a = first + i * (columns + 1) + k, b = a + columns + 1;
        obj << "f " << a << " " << a + 1 << " " << b << "\nf " << a + 1 << " " << b + 1 << " " << b << "\n";
      }
    }
    first += (rings + 1) * (columns + 1);
  }
}

TEST_F(MeasureAccuracy,
       a_hole_where_surfaces_touch_ends_with_exit_code_1_and_packs_that_it_builds_have_none) {
  const std::string model = folder.file("sphere.obj"), around = folder.file("around.json");
  write_sphere(model, 8, 48);
  std::ofstream(around) << R"({"triptych_path": 1, "fov_y_degrees": 90, "frames": [)"
                        << R"({"eye": [1, 0, 2], "target": [5, 1, 3], "up": [0, 1, 0]},)"
                        << R"({"eye": [-2, 1, 1], "target": [-3, 0, 6], "up": [0, 1, 0]},)"
                        << R"({"eye": [-1, 0.5, 0], "target": [0, 0.5, 0], "up": [0, 1, 0]},)"
                        << R"({"eye": [-0.7, 0.5, 0.2], "target": [-0.16, 0.67, 1.04], "up": [0, 1, 0]},)"
                        << R"({"eye": [-0.4, 0.5, 0.4], "target": [-0.82, 0.68, 1.31], "up": [0, 1, 0]},)"
                        << R"({"eye": [-0.1, 0.5, 0.6], "target": [-1.09, 0.53, 0.74], "up": [0, 1, 0]},)"
                        << R"({"eye": [0.2, 0.5, 0.8], "target": [-0.45, 0.35, 0.04], "up": [0, 1, 0]},)"
                        << R"({"eye": [0.5, 0.5, 1], "target": [0.78, 0.31, 0.04], "up": [0, 1, 0]}]})";
  const std::string build = "--part-triangles 300 --leaf-triangles 300 --hlod-triangles 48";
  const std::vector<std::string> common = {"measure", "accuracy", "--model",      model,           "--path",
                                           around,    "-o",       output,         "--json",        json,
                                           "--size",  "160x120",  "--strategies", "occlusion",     "--shifts",
                                           "0",       "--build",  build,          "--pixel-error", "8"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), common.begin(), common.end());
    return more;
  };
  run(with({"--build", build + " --keep none"}));
  const nlohmann::json rows = json_of(json)["rows"];
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_NE(rows[0]["build"]["keep"].get<std::string>().find("touching"), std::string::npos);
  EXPECT_EQ(rows[1]["build"]["keep"], "none");
  EXPECT_EQ(rows[0]["hole_pixels"], 0);
  EXPECT_FALSE(rows[0]["promised"]["holes"]["limit_a_million"].is_null());
  EXPECT_GT(rows[1]["hole_pixels"].get<int>(), 0) << "nothing to keep";
  for (const nlohmann::json& row : rows) {
    EXPECT_GT(row["build_seconds"].get<double>(), 0);
    EXPECT_GT(row["pack_bytes"].get<uint64_t>(), 0u);
  }
  Program loose(with({"--inject", "loose-contacts"}));
  EXPECT_EQ(loose.wait(), 1) << loose.errors();
  const std::string message = loose.errors();
  EXPECT_NE(message.find("pixels of holes"), std::string::npos) << message;
  EXPECT_NE(message.find("--keep touching"), std::string::npos) << message;
  EXPECT_NE(message.find(" at 8 px, frame "), std::string::npos) << message;
  EXPECT_NE(message.find("of drawable "), std::string::npos) << message;
}

TEST_F(MeasureAccuracy, builds_that_are_none_are_usage_errors) {
  const std::string pack = write_pack(small_pack());
  for (const std::vector<std::string>& more : {std::vector<std::string>{"--build", "--keep none"},
                                               {"--model", path},
                                               {"--model", path, "--build", "--keep everything"},
                                               {"--model", path, "--build", "other.obj"},
                                               {"--model", path, "--build", "--flat", "--build", "--flat"}}) {
    Program program(words(pack, more));
    EXPECT_EQ(program.wait(), 2) << more.back();
    EXPECT_NE(program.errors().find("--build"), std::string::npos) << program.errors();
  }
}

TEST_F(MeasureAccuracy, takes_pictures_of_a_few_pixels) {
  const std::string pack = write_pack(small_pack());
  run(words(pack, {"--pixel-error", "1", "--sizes", "1x1,3x2,2x9", "--compare", "2"}));
  const nlohmann::json report = json_of(json);
  EXPECT_EQ(report["violations"], 0);
  std::set<std::string> sizes;
  for (const nlohmann::json& row : report["rows"]) {
    sizes.insert(row["size"].get<std::string>());
    for (const char* key : {"wrong_pixel_share", "hole_share", "rmse", "ssim", "popping"})
      EXPECT_TRUE(row[key].is_number()) << key << " of " << row["size"];  // null is what a NaN becomes
  }
  EXPECT_EQ(sizes, (std::set<std::string>{"1x1", "2x9", "3x2"}));
}

TEST_F(MeasureAccuracy, sizes_errors_and_strategies_that_are_none_are_usage_errors) {
  const std::string pack = write_pack(small_pack());
  for (const auto& [flag, value] : {std::pair{"--sizes", "65"},
                                    {"--pixel-error", "1,0"},
                                    {"--strategies", "magic"},
                                    {"--samples", "1,3"},
                                    {"--devices", "abacus"}}) {
    Program program(words(pack, {flag, value}));
    EXPECT_EQ(program.wait(), 2) << flag;
    EXPECT_NE(program.errors().find(flag), std::string::npos) << program.errors();
  }
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--min-pixels", "4", "--strategies", "occlusion,frustum"},
        {"--device", "cpu", "--devices", "cpu"},
        {"--size", "33x21", "--sizes", "65x47"}}) {
    Program program(words(pack, more));
    EXPECT_EQ(program.wait(), 2) << more.front();
    EXPECT_NE(program.errors().find(more.front()), std::string::npos) << program.errors();
  }
  EXPECT_FALSE(std::filesystem::exists(output));
}

}  // namespace
}  // namespace triptych::test
