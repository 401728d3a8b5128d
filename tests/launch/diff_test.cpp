// `diff` as scripts use it: exit codes, JSON, and the pack that shows what changed.
#include "tests/session/program.hpp"

#include <fstream>
#include <gtest/gtest.h>

namespace triptych::test {
namespace {

/// Cubes in a row by their names; a cube moves and is painted by what follows.
struct Cube {
  std::string name;
  double x = 0;
  std::string material = "grey";
};

class Diff : public testing::Test {
 protected:
  std::string build(const std::string& name, const std::vector<Cube>& cubes,
                    const std::vector<std::string>& flags = {}) const {
    std::ofstream(folder.file("colors.mtl")) << "newmtl grey\nKd 0.5 0.5 0.5\nnewmtl red\nKd 1 0 0\n";
    std::ofstream out(folder.file(name + ".obj"));
    out << "mtllib colors.mtl\n";
    int first = 1;
    for (const Cube& cube : cubes) {
      out << "o " << cube.name << "\nusemtl " << cube.material << "\n";
      for (int corner = 0; corner < 8; ++corner)
        out << "v " << cube.x + (corner & 1) << " " << (corner >> 1 & 1) << " " << (corner >> 2) << "\n";
      for (const auto& face : {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
                               std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}}) {
        out << "f";
        for (const int corner : face) out << " " << first + corner;
        out << "\n";
      }
      first += 8;
    }
    out.close();
    std::vector<std::string> words = {"build", folder.file(name + ".obj"), "-o", folder.file(name + ".tpk")};
    words.insert(words.end(), flags.begin(), flags.end());
    run(words);
    return folder.file(name + ".tpk");
  }

  static int code(std::vector<std::string> words) {
    words.insert(words.begin(), "diff");
    return Program(std::move(words)).wait();
  }

  Folder folder;
  const std::vector<Cube> usual = {{"floor", 0}, {"door", 3}, {"roof", 6}};
};

TEST_F(Diff, says_by_its_exit_code_whether_packs_are_equal_or_something_failed) {
  const std::string one = build("one", usual);
  const std::string same = build("same", usual, {"--keep", "none", "--simplifier", "meshopt"});
  const std::string other = build("other", {{"floor", 0}, {"door", 3}});
  EXPECT_EQ(code({one, one}), 0);
  EXPECT_EQ(code({one, same}), 0);
  EXPECT_EQ(code({one, other}), 1);
  EXPECT_EQ(code({one, folder.file("none.tpk")}), 2);
  EXPECT_EQ(code({one, folder.file("one.obj")}), 2) << "no pack";
  EXPECT_EQ(code({one}), 2) << "usage";
  std::string bytes = text_of(other);
  bytes.at(60) ^= 1;  // of a chunk
  std::ofstream(other, std::ios::binary) << bytes;
  EXPECT_EQ(code({one, other}), 2) << "damage";
}

TEST_F(Diff, says_with_which_options_packs_were_built_otherwise) {
  const std::string one = build("one", usual), same = build("same", usual),
                    other = build("other", usual, {"--keep", "none"}),
                    coarse = build("coarse", usual, {"--chord", "0.5"}), json = folder.file("diff.json");
  EXPECT_EQ(code({one, same, "--json", json}), 0);
  EXPECT_EQ(json_of(json)["built_otherwise"].size(), 0u);
  EXPECT_EQ(code({one, other, "--json", json}), 0);
  EXPECT_EQ(json_of(json)["built_otherwise"],
            nlohmann::json::parse(
                R"([{"option": "keep", "before": "cover,order,planes,shade,touching", "after": "none"}])"));
  EXPECT_EQ(code({one, coarse, "--json", json}), 0);
  EXPECT_EQ(json_of(json)["built_otherwise"],
            nlohmann::json::parse(R"([{"option": "chord", "before": null, "after": "0.5"}])"));
}

TEST_F(Diff, json_has_counts_types_and_every_object_that_changed) {
  const std::string one = build("one", usual);
  const std::string other = build("other", {{"floor", 0, "red"}, {"door", 4.5}, {"lamp", 9}});
  const std::string json = folder.file("diff.json");
  EXPECT_EQ(code({one, other, "--json", json}), 1);
  const nlohmann::json report = json_of(json);
  EXPECT_EQ(report["equal"], false);
  EXPECT_EQ(report["counts"], (nlohmann::json{{"added", 1},
                                              {"removed", 1},
                                              {"moved", 1},
                                              {"recoloured", 1},
                                              {"reshaped", 0},
                                              {"told_otherwise", 0},
                                              {"unchanged", 0}}));
  std::map<std::string, nlohmann::json> changes;
  for (const nlohmann::json& object : report["objects"]) changes[object["name"]] = object;
  ASSERT_EQ(changes.size(), 4u);
  EXPECT_EQ(changes["lamp"]["change"], "added");
  EXPECT_FALSE(changes["lamp"].contains("before"));
  EXPECT_EQ(changes["roof"]["change"], "removed");
  EXPECT_FALSE(changes["roof"].contains("after"));
  EXPECT_EQ(changes["floor"]["change"], "recoloured");
  EXPECT_EQ(changes["door"]["change"], "moved");
  EXPECT_NEAR(changes["door"]["offset"][0].get<double>(), 1.5, 1e-5);
  EXPECT_EQ(changes["door"]["after"]["triangles"], 12);
}

TEST_F(Diff, writes_a_sound_pack_of_both_that_tells_what_became_of_each) {
  const std::string one = build("one", usual), other = build("other", {{"floor", 0}, {"door", 4.5}});
  const std::string both = folder.file("both.tpk"), json = folder.file("both.json");
  EXPECT_EQ(code({one, other, "-o", both}), 1);
  run({"check", both});
  run({"info", both, "--objects", "--find", "gone", "--json", json});
  const nlohmann::json found = json_of(json)["source_objects"];
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0]["name"], "roof");
  EXPECT_FALSE(found[0]["scene_nodes"].empty());
  EXPECT_EQ(found[0]["properties"]["Revision"]["State"], "gone");
  EXPECT_EQ(code({other, both}), 1);
  EXPECT_EQ(code({one, other, "-o", one}), 2) << "it would be written over one of them";
}

}  // namespace
}  // namespace triptych::test
