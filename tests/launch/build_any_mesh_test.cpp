// What engineers really have, through the whole of `build` and `check`: nothing vanishes unsaid.
#include "tests/session/program.hpp"

#include <fmt/core.h>

namespace triptych {
namespace {

using test::Folder;

/// An OBJ file, and what must come of it.
struct AnyMesh {
  const char* name;
  std::string obj;
  uint64_t source = 0;    ///< triangles that the file holds
  uint64_t dropped = 0;   ///< of them
  uint64_t welded = 0;    ///< vertices that met others
  uint64_t repaired = 0;  ///< triangles beyond the second at an edge
};

std::ostream& operator<<(std::ostream& out, const AnyMesh& mesh) { return out << mesh.name; }

/// Boxes at one place, each an object of its own.
std::string stacked(int count) {
  std::string obj;
  for (int i = 0; i < 4; ++i) obj += fmt::format("v {} {} {}\n", i & 1, i >> 1, i / 3);
  for (int i = 0; i < count; ++i) obj += fmt::format("o part{}\nf 1 2 3\nf 2 4 3\n", i);
  return obj;
}

/// Triangles on a bent sheet, each with three vertices of its own.
std::string sheet_in_pieces(int cells) {
  std::string obj;
  const auto corner = [&](int x, int y) { obj += fmt::format("v {} {} {}\n", x, y, 0.01 * x * y); };
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      corner(x, y), corner(x + 1, y), corner(x + 1, y + 1);
      corner(x, y), corner(x + 1, y + 1), corner(x, y + 1);
      obj += "f -6 -5 -4\nf -3 -2 -1\n";
    }
  }
  return obj;
}

/// Three bent sheets that share one side, edge by edge.
std::string sheets_on_a_spine(int cells) {
  std::string obj;
  const auto vertex = [&](int sheet, int x, int y) {
    return x == 0 ? y + 1 : (cells + 1) * (sheet * cells + x) + y + 1;
  };
  for (int y = 0; y <= cells; ++y) obj += fmt::format("v 0 0 {}\n", y);
  for (int sheet = 0; sheet < 3; ++sheet) {
    for (int x = 1; x <= cells; ++x) {
      for (int y = 0; y <= cells; ++y)
        obj += fmt::format("v {} {} {}\n", sheet == 1 ? -x : x,
                           sheet == 2 ? -0.1 * x : 0.1 * x + 0.01 * x * y, y);
    }
  }
  for (int sheet = 0; sheet < 3; ++sheet) {
    for (int x = 0; x < cells; ++x) {
      for (int y = 0; y < cells; ++y) {
        const int a = vertex(sheet, x, y), b = vertex(sheet, x + 1, y), c = vertex(sheet, x + 1, y + 1),
                  d = vertex(sheet, x, y + 1);
        obj += fmt::format("f {} {} {}\nf {} {} {}\n", a, b, c, a, c, d);
      }
    }
  }
  return obj;
}

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

const std::vector<AnyMesh> meshes = {
    {"one_triangle", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", 1},
    {"three_sheets_at_one_edge", square + "v 0.5 0.5 1\nv 0.5 0.5 -1\nv 0 0 2\nf 1 3 2\nf 1 3 5\nf 1 3 6\n",
     3},
    {"three_sheets_on_a_spine", sheets_on_a_spine(8), 384, 0, 0, 8},
    {"two_triangles_at_one_vertex", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\nf 1 2 3\nf 1 4 5\n", 2},
    {"a_soup", sheet_in_pieces(20), 800, 0, 2400 - 441},
    {"a_corner_in_the_middle_of_an_edge",
     square + "v 0.5 0 0\nv 0 -1 0\nv 1 -1 0\nf 1 2 3\nf 1 3 4\nf 1 6 5\nf 5 7 2\nf 5 6 7\n", 5},
    {"a_triangle_three_times", square + "f 1 2 3\nf 2 3 1\nf 3 1 2\n", 3, 2},
    {"both_sides_of_a_triangle", square + "f 1 2 3\nf 3 2 1\n", 2},
    {"triangles_without_area", square + "v 2 0 0\nf 1 2 3\nf 1 1 2\nf 1 2 5\nf 4 4 4\n", 4, 3},
    {"overlapping_triangles_in_one_plane",
     square + "v 0.2 0.2 0\nv 0.9 0.2 0\nv 0.5 0.8 0\nf 1 2 3\nf 1 3 4\nf 5 6 7\n", 3},
    {"neighbours_turned_over", square + "f 1 2 3\nf 1 4 3\n", 2},
    {"vertices_that_nothing_uses", square + "v 1e30 7 7\nf 1 2 3\n", 1},
    {"vertices_that_are_not_finite", square + "v nan 0 0\nv 0 inf 0\nf 1 2 3\nf 1 2 5\nf 3 4 6\n", 3, 2},
    {"an_object_without_area", square + "v 2 0 0\no good\nf 1 2 3\no line\nf 1 2 5\nf 2 5 1\n", 3, 2},
    {"objects_at_one_place", stacked(3000), 6000},
    {"a_pentagon_that_is_not_planar", square + "v -0.5 0.5 0.7\nf 1 2 3 4 5\n", 3},
    {"a_concave_face", square + "v 0.5 0.2 0\nf 1 2 3 5 4\n", 3}};

class BuildAnyMesh : public testing::TestWithParam<AnyMesh> {};

TEST_P(BuildAnyMesh, makes_a_sound_pack_and_says_what_it_dropped) {
  const Folder folder;
  const AnyMesh& mesh = GetParam();
  const std::string obj = folder.file("a.obj"), pack = folder.file("a.tpk");
  std::ofstream(obj) << mesh.obj;
  test::run({"build", obj, "-o", pack, "--json", folder.file("build.json")});
  test::run({"check", pack, "--json", folder.file("check.json")});
  test::run({"info", pack, "--json", folder.file("info.json")});
  const auto build = test::json_of(folder.file("build.json")), info = test::json_of(folder.file("info.json"));
  // Non-finite triangles are gone before the model is.
  const uint64_t gone_in_import = mesh.source - build["placed_triangles"].get<uint64_t>();
  EXPECT_LE(gone_in_import, mesh.dropped);
  EXPECT_EQ(build["import"]["dropped_triangles"], mesh.dropped);
  EXPECT_EQ(build["import"]["welded_vertices"], mesh.welded);
  EXPECT_EQ(build["import"]["repaired_edges"], mesh.repaired);
  EXPECT_EQ(info["import"], build["import"]) << "stored as it was printed";
  EXPECT_EQ(test::json_of(folder.file("check.json"))["drawables_not_checked"], 0);
}

INSTANTIATE_TEST_SUITE_P(Of, BuildAnyMesh, testing::ValuesIn(meshes),
                         [](const auto& of) { return std::string(of.param.name); });

TEST(BuildAnyName, names_that_are_no_utf_8_do_not_lose_the_report) {
  const Folder folder;
  const std::string obj = folder.file("a.obj"), pack = folder.file("a.tpk"), json = folder.file("a.json");
  std::ofstream(obj) << "mtllib M\xfc"
                     << "ll.mtl\n"
                     << square << "f 1 2 3\n";
  test::run({"build", obj, "-o", pack, "--json", json});
  EXPECT_NE(test::json_of(json)["import"]["warnings"].dump().find("M\xef\xbf\xbdll.mtl"), std::string::npos);
  test::run({"info", pack, "--json", json});
}

TEST(BuildAnyName, the_folder_of_a_model_does_not_get_into_its_pack) {
  const Folder folder;
  std::vector<std::string> packs;
  for (const std::string name : {"one", "another"}) {
    std::filesystem::create_directory(folder.file(name));
    const std::string obj = folder.file(name + "/a.obj"), json = folder.file(name + "/a.json");
    std::ofstream(obj) << "mtllib not-there.mtl\n" << square << "f 1 2 3\n";
    test::run({"build", obj, "-o", folder.file(name + "/a.tpk"), "--json", json});
    EXPECT_GT(test::json_of(json)["import"]["warnings"].size(), 0u);
    packs.push_back(test::text_of(folder.file(name + "/a.tpk")));
  }
  EXPECT_EQ(packs[0], packs[1]);
}

TEST(BuildNoMesh, a_file_with_nothing_but_triangles_without_area_is_one_line) {
  const Folder folder;
  const std::string obj = folder.file("a.obj");
  std::ofstream(obj) << square << "f 1 1 2\nf 3 3 3\n";
  EXPECT_NE(test::failure({"build", obj, "-o", folder.file("a.tpk")}).find(obj + ": holds no triangle"),
            std::string::npos);
  EXPECT_EQ(folder.files(), 1u);
}

}  // namespace
}  // namespace triptych
