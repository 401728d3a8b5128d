// `measure build`, `hierarchy`, `simplifiers` and `info` as scripts use them.
#include "tests/session/program.hpp"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <set>

namespace triptych::test {
namespace {

/// model.obj, a field of bumpy slabs, and path.json, a few frames over it.
class MeasureCommands : public testing::Test {
 protected:
  MeasureCommands() {
    std::ofstream out(model);
    constexpr int cells = 24;
    int first = 1;
    for (int slab = 0; slab < 9; ++slab) {
      out << "o slab" << slab << "\n";
      for (int y = 0; y <= cells; ++y) {
        for (int x = 0; x <= cells; ++x)
          out << "v " << slab % 3 * 5 + x * 4.0 / cells << " " << 0.2 * std::sin(x * 0.7) * std::cos(y * 0.9)
              << " " << slab / 3 * 5 + y * 4.0 / cells << "\n";
      }
      for (int y = 0; y < cells; ++y) {
        for (int x = 0; x < cells; ++x) {
          const int a = first + y * (cells + 1) + x, b = a + cells + 1;
          out << "f " << a << " " << b << " " << a + 1 << "\nf " << a + 1 << " " << b << " " << b + 1 << "\n";
        }
      }
      first += (cells + 1) * (cells + 1);
    }
    nlohmann::json frames = nlohmann::json::array();
    for (int i = 0; i < 3; ++i)
      frames.push_back({{"eye", {7 + i, 3, 25 - i}}, {"target", {7, 0, 7}}, {"up", {0, 1, 0}}});
    std::ofstream(path) << nlohmann::json{{"triptych_path", 1}, {"fov_y_degrees", 60}, {"frames", frames}};
  }

  std::vector<std::string> measure(const std::string& what, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {
        "measure", what, model, "--json", json, "--leaf-triangles", "900", "--part-triangles", "400"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  Folder folder;
  const std::string model = folder.file("model.obj"), path = folder.file("path.json"),
                    json = folder.file("out.json");
  static constexpr int triangles = 9 * 24 * 24 * 2;
};

TEST_F(MeasureCommands, build_has_the_figures_of_the_build_alone_and_keeps_the_pack_on_demand) {
  run(measure("build", {"--keep-pack", folder.file("kept.tpk")}));
  const nlohmann::json report = json_of(json);
  EXPECT_EQ(report["source_triangles"], triangles);
  EXPECT_EQ(report["pack_bytes"], std::filesystem::file_size(folder.file("kept.tpk")));
  EXPECT_DOUBLE_EQ(report["bytes_per_triangle"].get<double>() * triangles,
                   report["pack_bytes"].get<double>());
  EXPECT_NEAR(report["triangles_per_second"].get<double>() * report["seconds"].get<double>(), triangles, 1);
  EXPECT_EQ(report["yardstick"]["triangles"], triangles);
  EXPECT_GT(report["yardstick_triangles_per_second"].get<double>(), 0);
  EXPECT_GT(report["peak_rss_bytes"].get<uint64_t>(), 1u << 20);
  EXPECT_EQ(report["stages"][0]["name"], "import");
  double stages = 0;
  for (const auto& stage : report["stages"]) stages += stage["seconds"].get<double>();
  EXPECT_LE(stages, report["seconds"].get<double>());

  run({"build", model, "-o", folder.file("built.tpk"), "--leaf-triangles", "900", "--part-triangles", "400"});
  EXPECT_EQ(text_of(folder.file("kept.tpk")), text_of(folder.file("built.tpk")));
  EXPECT_EQ(folder.files(), 5u) << "something else was left behind";
}

TEST_F(MeasureCommands, a_build_does_not_take_the_place_of_its_model) {
  const std::string before = text_of(model);
  EXPECT_NE(failure({"build", model, "-o", model}).find("--output would be written over"), std::string::npos);
  EXPECT_NE(failure({"build", model, "-o", folder.file("x.tpk"), "--json", folder.file("./model.obj")})
                .find("--json would be written over"),
            std::string::npos);
  EXPECT_EQ(text_of(model), before);
  // Nor that of a file which the model names.
  const std::string materials = folder.file("model.mtl");
  std::ofstream(materials) << "newmtl grey\n";
  std::ofstream(model) << "mtllib model.mtl\n" << before;
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"build", model, "-o", materials},
           {"build", model, "-o", folder.file("x.tpk"), "--json", materials},
           {"measure", "build", model, "--keep-pack", materials},
           {"measure", "build", model, "--json", materials},
           {"measure", "yardstick", model, "--json", materials},
           {"measure", "hierarchy", model, "--path", path, "--json", materials},
           {"measure", "simplifiers", model, "--path", path, "--json", materials}})
    EXPECT_EQ(failure(words), "triptych: " + materials + ": is a file of the model, which would be lost");
  EXPECT_EQ(text_of(materials), "newmtl grey\n");
  EXPECT_EQ(folder.files(), 3u);
}

TEST_F(MeasureCommands, build_of_a_broken_model_is_one_line_and_leaves_nothing) {
  std::ofstream(model) << "v 0 0 0\nf 1 2 900\n";
  const std::string line = failure(measure("build", {"--keep-pack", folder.file("kept.tpk")}));
  EXPECT_NE(line.find("model.obj"), std::string::npos) << line;
  EXPECT_EQ(folder.files(), 2u);
}

TEST_F(MeasureCommands, a_path_that_sees_nothing_has_numbers_all_the_same) {
  const nlohmann::json away = {{"eye", {7, 9, 7}}, {"target", {7, 19, 7}}, {"up", {1, 0, 0}}};
  std::ofstream(path) << nlohmann::json{
      {"triptych_path", 1}, {"fov_y_degrees", 60}, {"frames", {away, away}}};
  const std::string pack = folder.file("kept.tpk");
  run(measure("hierarchy", {"--path", path, "--size", "32x32", "--rounds", "1"}));
  EXPECT_EQ(text_of(json).find("null"), std::string::npos) << text_of(json);
  EXPECT_EQ(json_of(json)["rows"][0]["drawn_triangles"]["max"], 0);
  run({"build", model, "-o", pack});
  run({"measure", "session", pack, "--path", path, "--size", "32x32", "--json", json});
  nlohmann::json report = json_of(json);
  report.erase("section");  // has no box, and says so
  EXPECT_EQ(report.dump().find("null"), std::string::npos) << report.dump(2);
  EXPECT_EQ(report["identical_frames"], 2);
}

TEST_F(MeasureCommands, hierarchy_puts_both_hierarchies_side_by_side) {
  run(measure("hierarchy", {"--path", path, "--size", "96x64", "--rounds", "2"}));
  const nlohmann::json report = json_of(json);
  ASSERT_EQ(report["rows"].size(), 2u);
  EXPECT_EQ(report["rows"][0]["hierarchy"], "pcp");
  EXPECT_EQ(report["rows"][1]["hierarchy"], "median_split");
  for (const nlohmann::json& row : report["rows"]) {
    EXPECT_GE(row["culling_efficiency"].get<double>(), 1);
    EXPECT_EQ(row["identical_frames"], 3);
    EXPECT_GT(row["drawn_triangles"]["p50"].get<double>(), 0);
    EXPECT_GT(row["frame_ms"]["p50"].get<double>(), 0);
    EXPECT_TRUE(row["queries_per_frame"].is_number());
  }
}

TEST_F(MeasureCommands, hierarchy_notices_culling_that_withholds) {
  const std::string line = failure(
      measure("hierarchy", {"--path", path, "--size", "96x64", "--rounds", "1", "--inject", "withheld-id"}));
  EXPECT_NE(line.find("un-culled"), std::string::npos) << line;
}

TEST_F(MeasureCommands, simplifiers_keep_every_pixel_error_and_draw_less_for_larger_ones) {
  run(measure("simplifiers",
              {"--path", path, "--size", "96x64", "--pixel-error", "0.5,2,8", "--points", "200000"}));
  const nlohmann::json report = json_of(json);
  ASSERT_EQ(report["rows"].size(), 3u * 2u * 3u);
  std::set<std::string> simplifiers;
  uint64_t measured = 0;
  for (size_t i = 0; i < report["rows"].size(); ++i) {
    const nlohmann::json& row = report["rows"][i];
    simplifiers.insert(row["simplifier"].get<std::string>() + row["bound"].get<std::string>());
    EXPECT_LE(row["deviation_px_max"].get<double>(), row["pixel_error"].get<double>() * 1.001 + 0.01);
    measured += row["drawables_measured"].get<uint64_t>();
    if (i % 3 > 0) {
      EXPECT_LE(row["drawn_triangles"].get<double>(), report["rows"][i - 1]["drawn_triangles"].get<double>());
    }
    if (row["drawables_measured"] > 0) {
      EXPECT_GE(row["bound_over_measured"]["p50"].get<double>(), 1);
    }
  }
  EXPECT_EQ(simplifiers.size(), 6u);
  EXPECT_GT(measured, 0u);
}

TEST_F(MeasureCommands, a_path_that_is_missing_is_said_before_anything_is_built) {
  for (const char* what : {"hierarchy", "simplifiers"}) {
    const std::string line = failure(measure(what, {"--path", folder.file("none.json")}));
    EXPECT_NE(line.find("none.json"), std::string::npos) << line;
  }
}

TEST_F(MeasureCommands, info_has_the_papers_table_and_the_hierarchys_quality) {
  const std::string built = folder.file("built.json");
  run({"build", model, "-o", folder.file("built.tpk"), "--leaf-triangles", "900", "--part-triangles", "400",
       "--json", built});
  run({"info", folder.file("built.tpk"), "--json", json});
  const nlohmann::json report = json_of(json);
  for (const char* key : {"initial", "partition1", "clusters", "partition2"})
    EXPECT_GT(report["objects"][key].get<int>(), 0) << key;
  const nlohmann::json& hierarchy = report["hierarchy"];
  EXPECT_EQ(hierarchy["depth"]["max"], report["levels"]);
  EXPECT_EQ(hierarchy["levels"].size(), report["levels"]);
  uint64_t drawables = 0, nodes = 0;
  for (const nlohmann::json& level : hierarchy["levels"]) {
    drawables += level["drawables"].get<uint64_t>();
    nodes += level["scene_nodes"].get<uint64_t>();
  }
  EXPECT_EQ(drawables, report["drawables"]);
  EXPECT_EQ(nodes, report["scene_nodes"]);
  EXPECT_EQ(report["build"]["leaf-triangles"], "900") << "how it was built";
  EXPECT_EQ(report["build"]["keep"], json_of(built)["keep"]);
  EXPECT_GT(hierarchy["balance"]["mean"].get<double>(), 0);
  EXPECT_LT(hierarchy["overlap"]["mean"].get<double>(), 1);
}

}  // namespace
}  // namespace triptych::test
