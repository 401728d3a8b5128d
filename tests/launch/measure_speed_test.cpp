// `measure speed` as scripts use it.
#include "tests/session/program.hpp"
#include "tests/support/scenes.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <map>

namespace triptych::test {
namespace {

class MeasureSpeed : public testing::Test {
 protected:
  MeasureSpeed() {
    scenes::write_pack("room", pack);
    const Box box =
        scenes::pack("room").skeleton().lattice().box(scenes::pack("room").skeleton().scene_nodes[0].box);
    const glm::dvec3 middle = (box.lo + box.hi) * 0.5;
    nlohmann::json frames = nlohmann::json::array();
    for (int i = 0; i < 5; ++i) {
      const glm::dvec3 eye = middle + (box.hi - middle) * (0.2 + 0.3 * i);
      frames.push_back(
          {{"eye", {eye.x, eye.y, eye.z}}, {"target", {middle.x, middle.y, middle.z}}, {"up", {0, 1, 0}}});
    }
    std::ofstream(path) << nlohmann::json{{"triptych_path", 1}, {"fov_y_degrees", 60}, {"frames", frames}};
  }
  nlohmann::json measure(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"measure", "speed", pack,     "--path", path,
                                      "--size",  "65x47", "--json", json};
    words.insert(words.end(), more.begin(), more.end());
    run(words);
    return json_of(json);
  }

  Folder folder;
  const std::string pack = folder.file("room.tpk"), path = folder.file("path.json"),
                    json = folder.file("out.json");
};

TEST_F(MeasureSpeed, has_a_row_a_method_and_the_ratios_that_can_be_formed) {
  const nlohmann::json report = measure({"--warm-up", "1"});
  EXPECT_EQ(report["frames"], 4);
  EXPECT_EQ(report["warm_up"], 1);
  std::map<std::string, nlohmann::json> rows;
  for (const nlohmann::json& row : report["rows"]) {
    const std::string method = row["method"], device = row.value("device", "");
    if (method == "embree") {
      EXPECT_EQ(device, "");
    } else {
      EXPECT_TRUE(device == "gl" || device == "cpu") << row;
    }
    EXPECT_TRUE(method != "everything" || device == "gl") << row;
    if (device != "gl" || method == "everything") rows[method] = row;
    for (const char* which : {"mean", "p50", "p95", "p99", "max"})
      EXPECT_GT(row["frame_ms"][which].get<double>(), 0) << row;
    for (const nlohmann::json& stage : row["stages_ms"])
      EXPECT_LE(stage["max"].get<double>(), row["frame_ms"]["max"].get<double>()) << row;
  }
  ASSERT_EQ(rows.size(), 6u);
  const auto triangles = [&](const char* method) {
    return rows.at(method).at("drawn_triangles").at("mean").get<double>();
  };
  EXPECT_GT(triangles("oracle"), 0);
  EXPECT_LE(triangles("oracle"), triangles("triptych"));
  EXPECT_LE(triangles("triptych"), triangles("frustum"));
  EXPECT_LE(triangles("oracle"), triangles("frustum-hidepth"));
  EXPECT_LE(triangles("frustum-hidepth"), triangles("frustum"));
  EXPECT_LE(triangles("frustum"), triangles("everything"));
  EXPECT_TRUE(rows["triptych"]["stages_ms"].contains("hardware_cull"));
  for (const char* ratio : {"triptych_over_embree", "triptych_over_oracle", "triptych_over_frustum",
                            "everything_over_triptych", "p95_over_median"})
    EXPECT_GT(report["ratios"][ratio].get<double>(), 0) << ratio;
  EXPECT_GE(report["ratios"]["triptych_triangles_over_oracle"].get<double>(), 1);
  EXPECT_GT(report["ratios"]["gl_over_cpu"].get<double>(), 0);
  EXPECT_GT(report["ratios"]["triptych_over_frustum_hidepth"].get<double>(), 0);
}

TEST_F(MeasureSpeed, and_hiding_take_sections_and_hidden_objects) {
  scenes::write_pack_with_objects("room", pack);
  const auto everything = [](const nlohmann::json& report) {
    return report["rows"][0]["drawn_triangles"]["mean"].get<double>();
  };
  const std::vector<std::string> methods = {"--methods", "everything,triptych,embree", "--device", "cpu"};
  const nlohmann::json whole = measure(methods);
  std::vector<std::string> words = methods;
  words.insert(words.end(), {"--hide", "layer:layer 1", "--section", "z<2"});
  const nlohmann::json some = measure(words);
  EXPECT_EQ(whole["hidden_objects"], 0);
  EXPECT_GT(some["hidden_objects"].get<int>(), 5);
  EXPECT_EQ(some["section"]["planes"].size(), 1u);
  EXPECT_LT(everything(some), everything(whole));

  run({"measure", "hiding", pack, "--path", path, "--size", "65x47", "--json", json, "--rounds", "2"});
  const nlohmann::json rows = json_of(json)["rows"];
  ASSERT_EQ(rows.size(), 5u);
  for (size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i]["hidden"] == "nothing", i == 0 || i > 2);
    EXPECT_EQ(rows[i]["section"] == "none", i < 3);
    EXPECT_GT(rows[i]["first_picture_ms"]["p50"].get<double>(), 0);
    EXPECT_GT(rows[i]["cold_picture_ms"].get<double>(), 0);
  }
}

TEST_F(MeasureSpeed, measures_only_the_methods_that_are_named) {
  const nlohmann::json report = measure({"--methods", "oracle,triptych", "--frames", "2"});
  ASSERT_EQ(report["rows"].size(), 4u) << "two on each device";
  EXPECT_EQ(report["frames"], 1) << "one is left however long the warm-up";
  EXPECT_FALSE(report["ratios"].contains("triptych_over_embree"));
}

TEST_F(MeasureSpeed, samples_a_pixel_are_said_and_all_methods_draw_them) {
  const nlohmann::json report = measure({"--samples", "4", "--warm-up", "1"});
  EXPECT_EQ(report["samples"], 4);
  for (const nlohmann::json& row : report["rows"]) EXPECT_TRUE(row["frame_ms"].is_object()) << row;
  Program wrong({"measure", "speed", pack, "--path", path, "--samples", "3"});
  EXPECT_EQ(wrong.wait(), 2);
  EXPECT_NE(wrong.errors().find("--samples"), std::string::npos) << wrong.errors();
}

}  // namespace
}  // namespace triptych::test
