// Effects as scripts use them: `sample effects`, `measure effects`, and `--effects`.
#include "tests/session/program.hpp"

#include <gtest/gtest.h>

namespace triptych::test {
namespace {

/// The exhibition and its twins; packs of those that a test asks for.
class MeasureEffects : public testing::Test {
 protected:
  MeasureEffects() { run({"sample", "effects", "-o", folder.file("models")}); }

  std::vector<std::string> words(const std::string& name) const {
    const std::string pack = folder.file(name + ".tpk");
    if (!std::filesystem::exists(pack)) run({"build", folder.file("models/" + name + ".gltf"), "-o", pack});
    return {pack,     "--path", folder.file("models/walk.json"), "--size", "64x48", "--frames", "3",
            "--json", json};
  }
  nlohmann::json measured(const std::string& name, std::vector<std::string> more = {}) const {
    std::vector<std::string> all = {"measure", "effects", "--rounds", "1"};
    for (const std::string& word : words(name)) all.push_back(word);
    all.insert(all.end(), more.begin(), more.end());
    run(all);
    return json_of(json);
  }

  Folder folder;
  const std::string json = folder.file("out.json");
};

TEST_F(MeasureEffects, adds_one_after_the_other_of_those_that_the_model_calls_for) {
  const nlohmann::json all = measured("scene");
  ASSERT_EQ(all["rows"].size(), 7u);
  EXPECT_EQ(all["rows"][0]["effect"], "none");
  EXPECT_EQ(all["rows"][1]["effect"], "vertex-colours");
  EXPECT_EQ(all["rows"][2]["effect"], "transparency");
  EXPECT_EQ(all["rows"][3]["effect"], "smooth-normals");
  EXPECT_EQ(all["rows"][4]["effect"], "textures");
  EXPECT_EQ(all["rows"][5]["effect"], "emission");
  EXPECT_EQ(all["rows"][6]["effect"], "moving-instances");
  for (const nlohmann::json& row : all["rows"]) {
    const bool used = row["effect"] != "none";
    EXPECT_EQ(row["frames"], used ? 3 : 0) << row;
    EXPECT_EQ(row["simulation_steps"].get<double>() > 0, row["effect"] == "moving-instances") << row;
    if (row["effect"] == "moving-instances") continue;  // it has fragments of its own on no device
    EXPECT_EQ(row["fragments"].get<double>() > 0,
              used && (row["effect"] == "transparency" || all["device"] != "gl"))
        << row;
    for (const char* key : {"frame_ms", "draws", "binds", "upload_bytes", "variants", "simulation_steps"})
      EXPECT_TRUE(row.contains(key)) << key;
  }
}

TEST_F(MeasureEffects, has_one_row_for_a_model_that_calls_for_none) {
  const nlohmann::json plain = measured("plain");
  ASSERT_EQ(plain["rows"].size(), 1u);
  const nlohmann::json& row = plain["rows"][0];
  for (const char* count :
       {"draws", "binds", "upload_bytes", "fragments", "variants", "frames", "simulation_steps"})
    EXPECT_EQ(row[count], 0) << count;
}

TEST_F(MeasureEffects, what_moves_is_evaluated_once_a_frame_where_it_may_be_seen) {
  const nlohmann::json moving = measured("moving-instances");
  ASSERT_EQ(moving["rows"].size(), 2u);
  EXPECT_EQ(moving["rows"][0]["simulation_steps"], 0);
  EXPECT_GT(moving["rows"][1]["simulation_steps"], 0);
  EXPECT_LE(moving["rows"][1]["simulation_steps"], 2) << "the door with its knob, and the fan";
}

TEST_F(MeasureEffects, only_those_that_are_switched_on) {
  const nlohmann::json some = measured("scene", {"--effects", "transparency"});
  ASSERT_EQ(some["rows"].size(), 2u);
  EXPECT_EQ(some["rows"][1]["effect"], "transparency");
}

TEST_F(MeasureEffects, switched_off_leave_the_picture_of_the_model_without) {
  const auto picture = [&](const std::string& name, const std::string& effects) {
    const std::string pictures = folder.file("pictures-" + name + effects);
    std::vector<std::string> all = {"render", "-o", pictures, "--effects", effects, "--full-detail"};
    for (const std::string& word : words(name)) all.push_back(word);
    run(all);
    return text_of(pictures + "/000001.png");
  };
  EXPECT_EQ(picture("transparency", "none"), picture("plain", "all"));
  EXPECT_EQ(picture("emission", "none"), picture("plain", "all"));
  EXPECT_NE(picture("textures", "all"), picture("textures", "none"));
  EXPECT_NE(picture("emission", "all"), picture("emission", "none"));
  EXPECT_NE(picture("transparency", "all"), picture("transparency", "none"));
  EXPECT_EQ(picture("transparency", "all"), picture("transparency", "transparency"));
  EXPECT_NE(picture("moving-instances", "all"), picture("moving-instances", "none"));
  EXPECT_EQ(picture("smooth-normals", "none"), picture("plain", "all"));
  EXPECT_NE(picture("smooth-normals", "all"), picture("smooth-normals", "none"));
}

TEST_F(MeasureEffects, are_named_by_each_run_that_draws_them_and_by_no_other) {
  const auto drawn = [&](const std::string& name) {
    std::vector<std::string> all = {"render", "-o", folder.file("pictures-of-" + name)};
    for (const std::string& word : words(name)) all.push_back(word);
    run(all);
    return json_of(json)["effects_drawn"];
  };
  const nlohmann::json glass = drawn("transparency");
  ASSERT_EQ(glass.size(), 1u);
  EXPECT_EQ(glass["transparency"]["frames"], 3);
  EXPECT_GT(glass["transparency"]["fragments"]["mean"], 0);
  for (const char* effect : {"smooth-normals", "textures", "emission"}) {
    const nlohmann::json of_effect = drawn(effect);
    ASSERT_EQ(of_effect.size(), 1u) << of_effect;
    EXPECT_EQ(of_effect[effect]["frames"], 3) << of_effect;
  }
  EXPECT_EQ(drawn("moving-instances").size(), 1u);
  EXPECT_EQ(drawn("plain"), nlohmann::json::object());
}

TEST_F(MeasureEffects, words_that_name_none_are_usage_errors) {
  for (const char* word : {"transparent", "all,transparency", "", ","}) {
    std::vector<std::string> all = {"render", "-o", folder.file("pictures"), "--effects", word};
    for (const std::string& more : words("plain")) all.push_back(more);
    Program program(all);
    EXPECT_EQ(program.wait(), 2) << word << ": " << program.errors();
  }
}

}  // namespace
}  // namespace triptych::test
