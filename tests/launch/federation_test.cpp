// Models of several files: whose is what, and whether they lie together.
#include "tests/session/program.hpp"

#include <fstream>
#include <gtest/gtest.h>

namespace triptych::test {
namespace {

class Federation : public testing::Test {
 protected:
  /// A box with a side of `size`, an object of its own in OBJ, without any name in STL.
  std::string box(const std::string& name, double size, double x) const {
    const std::string file = folder.file(name);
    std::filesystem::create_directories(std::filesystem::path(file).parent_path());
    std::ofstream out(file);
    const bool stl = name.ends_with(".stl");
    out << (stl ? "solid\n" : "o box\n");
    constexpr int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                 {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    const auto place = [&](int corner) {
      std::ostringstream text;
      text << x + size * (corner & 1) << " " << size * (corner >> 1 & 1) << " " << size * (corner >> 2);
      return text.str();
    };
    for (int corner = 0; !stl && corner < 8; ++corner) out << "v " << place(corner) << "\n";
    for (const auto& face : faces) {
      for (int half = 0; half < 2; ++half) {
        const int corners[3] = {face[0], face[1 + half], face[2 + half]};
        if (stl) out << "facet normal 0 0 0\nouter loop\n";
        if (!stl) out << "f";
        for (const int corner : corners) {
          if (stl) out << "vertex " << place(corner) << "\n";
          if (!stl) out << " " << corner + 1;
        }
        out << (stl ? "endloop\nendfacet\n" : "\n");
      }
    }
    if (stl) out << "endsolid\n";
    return file;
  }

  /// What info says of a pack of these files; `warnings` of its import.
  nlohmann::json built(std::vector<std::string> files) {
    files.insert(files.begin(), "build");
    files.insert(files.end(), {"-o", folder.file("all.tpk"), "--json", folder.file("build.json")});
    run(files);
    warnings.clear();
    const nlohmann::json report = json_of(folder.file("build.json"));
    for (const nlohmann::json& warning : report["import"]["warnings"])
      warnings += warning.get<std::string>() + "\n";
    run({"info", folder.file("all.tpk"), "--objects", "--json", folder.file("info.json")});
    return json_of(folder.file("info.json"));
  }

  Folder folder;
  std::string warnings;
};

TEST_F(Federation, each_file_is_an_object_that_holds_all_of_what_it_adds) {
  const nlohmann::json info = built({box("a.obj", 1, 0), box("b.stl", 1, 2), box("c.obj", 1, 4)});
  const nlohmann::json& files = info["files"];
  ASSERT_EQ(files.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(files[i]["name"], (std::vector{"a.obj", "b.stl", "c.obj"})[i]);
    EXPECT_EQ(files[i]["placed_triangles"], 12) << "also of what has no name";
    EXPECT_NEAR(files[i]["box"]["min"][0].get<double>(), 2.0 * static_cast<double>(i), 1e-5);
  }
  int boxes = 0;
  for (const nlohmann::json& object : info["source_objects"]) {
    if (object.value("name", "") != "box") continue;
    const nlohmann::json& file = files[boxes == 0 ? 0 : 2];
    EXPECT_EQ(object["parent"], file["id"]);
    EXPECT_EQ(object["path"], file["name"]);
    ++boxes;
  }
  EXPECT_EQ(boxes, 2);
  EXPECT_EQ(warnings, "");
}

TEST_F(Federation, files_of_one_name_are_told_apart_by_their_folders) {
  const nlohmann::json info = built({box("west/box.obj", 1, 0), box("east/box.obj", 1, 2)});
  ASSERT_EQ(info["files"].size(), 2u);
  EXPECT_EQ(info["files"][0]["name"], "west/box.obj");
  EXPECT_EQ(info["files"][1]["name"], "east/box.obj");
}

TEST_F(Federation, a_single_file_is_no_object) {
  const nlohmann::json info = built({box("a.obj", 1, 0)});
  EXPECT_TRUE(info["files"].empty());
  EXPECT_EQ(info["source_objects"].size(), 1u);
}

TEST_F(Federation, a_file_far_from_the_others_is_a_warning_with_both_names_and_the_distance) {
  built({box("a.obj", 10, 0), box("b.obj", 10, 15), box("c.obj", 10, 5025)});
  EXPECT_NE(warnings.find("\"b.obj\""), std::string::npos) << warnings;
  EXPECT_NE(warnings.find("\"c.obj\""), std::string::npos) << warnings;
  EXPECT_NE(warnings.find("5000 m apart"), std::string::npos) << warnings;
  EXPECT_NE(warnings.find("other origins"), std::string::npos) << warnings;
  EXPECT_EQ(warnings.find("\"a.obj\""), std::string::npos) << warnings;
}

TEST_F(Federation, a_file_in_other_units_is_a_warning_with_both_units) {
  built({box("metres.obj", 10, 0), box("millimetres.obj", 10000, 0)});
  EXPECT_NE(warnings.find("other units"), std::string::npos) << warnings;
  EXPECT_NE(warnings.find("1e+03 times as large"), std::string::npos) << warnings;
  EXPECT_NE(warnings.find("\"metres.obj\" (as the format says, or else metres; 17.32"), std::string::npos)
      << warnings;
}

}  // namespace
}  // namespace triptych::test
