// What the model's files name, from the file to `info --objects` and `explain`.
#include "tests/session/program.hpp"

#include <fstream>
#include <gtest/gtest.h>

namespace triptych::test {
namespace {

/// Sixteen cubes in a row, cube 3 within the tower, and a path with one frame that looks at them.
class NamedObjects : public testing::Test {
 protected:
  NamedObjects() {
    std::ofstream out(model);
    for (int cube = 0; cube < cubes; ++cube) {
      out << (cube == 3 ? "o tower\ng cube 3\n" : "o cube " + std::to_string(cube) + "\n");
      for (int corner = 0; corner < 8; ++corner)
        out << "v " << 2 * cube + (corner & 1) << " " << (corner >> 1 & 1) << " " << (corner >> 2) << "\n";
      for (const char* face : {"1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"}) {
        std::istringstream corners(face);
        out << "f";
        for (int corner = 0; corners >> corner;) out << " " << 8 * cube + corner;
        out << "\n";
      }
    }
    out.close();
    const nlohmann::json frame = {{"eye", {16, 0.5, 30}}, {"target", {16, 0.5, 0}}, {"up", {0, 1, 0}}};
    std::ofstream(path) << nlohmann::json{
        {"triptych_path", 1}, {"orthographic_height", 32}, {"frames", {frame}}};
    run({"build", model, "-o", pack, "--leaf-triangles", "24", "--part-triangles", "24"});
  }

  nlohmann::json listed(const std::string& find = "") const {
    std::vector<std::string> words = {"info", pack, "--objects", "--json", json};
    if (!find.empty()) words.insert(words.end(), {"--find", find});
    run(words);
    const nlohmann::json report = json_of(json);
    return report["source_objects"];
  }

  /// Names of the objects at a pixel of 64 × 64, which are half a unit wide.
  std::vector<std::string> explained(int x, int y, const std::string& pixel_error) const {
    run({"explain", pack, "--path", path, "--frame", "0", "--pixel",
         std::to_string(x) + "," + std::to_string(y), "--size", "64x64", "--pixel-error", pixel_error,
         "--device", "cpu", "--json", json});
    std::vector<std::string> names;
    const nlohmann::json report = json_of(json);
    for (const nlohmann::json& object : report["pixel"]["objects"]) names.push_back(object["name"]);
    return names;
  }

  static constexpr int cubes = 16;
  Folder folder;
  const std::string model = folder.file("model.obj"), path = folder.file("path.json"),
                    pack = folder.file("model.tpk"), json = folder.file("out.json");
};

TEST_F(NamedObjects, find_lists_those_with_a_word) {
  run({"find", pack, "CUBE 1", "--json", json});
  const nlohmann::json report = json_of(json);
  EXPECT_EQ(report["source_object_count"], cubes + 1);
  EXPECT_EQ(report["source_objects"], listed("cube 1"));
  EXPECT_EQ(report["source_objects"].size(), 7u) << "1 and 10 to 15";
  Program nothing({"find", pack, "no such thing", "--json", json});
  EXPECT_EQ(nothing.wait(), 1) << "as of grep: " << nothing.errors();
  EXPECT_TRUE(json_of(json)["source_objects"].empty());
  EXPECT_TRUE(nothing.complaints().empty()) << nothing.errors();
  Program damaged({"find", path, "CUBE"});
  EXPECT_EQ(damaged.wait(), 2) << "an error is another code than nothing found: " << damaged.errors();
  Program without({"find", pack});
  EXPECT_EQ(without.wait(), 2) << "a word is missing: " << without.errors();
}

TEST_F(NamedObjects, info_and_check_say_how_many_are_solid) {
  run({"info", pack, "--objects", "--json", json});
  const nlohmann::json solids = json_of(json)["solids"];
  EXPECT_GT(solids["placements"].get<int>(), 0);
  EXPECT_LE(solids["solid_placements"], solids["placements"]);
  EXPECT_GT(solids["objects"].get<int>(), 0);
  EXPECT_LE(solids["solid_objects"], solids["objects"]);
  run({"check", pack, "--json", json});
  EXPECT_EQ(json_of(json)["solids"], solids);
}

TEST_F(NamedObjects, that_are_all_open_have_no_cut_surfaces_and_info_says_so) {
  std::ofstream(model) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  run({"build", model, "-o", pack});
  Program info({"info", pack, "--objects", "--json", "-"});  // which has what is for people in the errors
  EXPECT_EQ(info.wait(), 0);
  EXPECT_NE(info.errors().find("none of 1 placed parts is solid"), std::string::npos) << info.errors();
}

TEST_F(NamedObjects, info_lists_and_finds_them) {
  const nlohmann::json all = listed();
  ASSERT_EQ(all.size(), cubes + 1u) << "and the tower";
  for (const nlohmann::json& object : all)
    EXPECT_EQ(object["scene_nodes"].empty(), object["name"] == "tower") << object;
  const nlohmann::json third = listed("CUBE 3");
  ASSERT_EQ(third.size(), 1u);
  EXPECT_EQ(third[0]["path"], "tower");
  EXPECT_EQ(json_of(json)["source_object_count"], cubes + 1);
  EXPECT_TRUE(listed("nothing like it").empty());
  run({"info", pack, "--json", json});
  EXPECT_FALSE(json_of(json).contains("source_objects")) << "they were not asked for";
}

TEST_F(NamedObjects, explain_names_the_object_at_a_pixel_at_every_level) {
  size_t coarse = 0;
  for (const int cube : {0, 3, 9, 15}) {
    EXPECT_EQ(explained(4 * cube + 1, 31, "0.01"), std::vector<std::string>{"cube " + std::to_string(cube)});
    const std::vector<std::string> names = explained(4 * cube + 1, 31, "2");  // a unit: half a cube may go
    EXPECT_LE(names.size(), 1u);
    if (names.empty()) continue;
    ++coarse;
    EXPECT_LE(std::abs(std::stoi(names[0].substr(5)) - cube), 1) << names[0];
  }
  EXPECT_GT(coarse, 0u);
}

TEST_F(NamedObjects, damage_of_names_stops_who_asks_for_them_and_nobody_else) {
  std::string bytes = text_of(pack);
  const size_t at = bytes.find("cube 0");
  ASSERT_NE(at, std::string::npos);
  bytes[at] = 'x';
  std::ofstream(pack, std::ios::binary) << bytes;
  run({"info", pack});
  const std::string line = failure({"info", pack, "--objects"});
  EXPECT_NE(line.find("section OBJS: byte"), std::string::npos) << line;
  Program check({"check", pack});
  EXPECT_EQ(check.wait(), 1) << "it asks for everything";
}

}  // namespace
}  // namespace triptych::test
