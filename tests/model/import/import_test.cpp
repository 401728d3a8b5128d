#include "model/import/import.hpp"

#include "import_support.hpp"

#include <glm/geometric.hpp>
#include <limits>

namespace triptych {
namespace {

using test::append;
using test::expect_robust;
using test::import_error;
using test::import_text;
using test::warns;
using test::write_model;

const std::string square_obj =
    "# a square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\no square\nf 1/1/1 2//1 3/1 4\n";

TEST(Import, an_unknown_extension_is_refused_with_the_names_of_the_known_ones) {
  const std::string error = import_error("kind.xyz", "hello");
  for (const char* known : {".gltf", ".glb", ".obj", ".ply", ".stl"})
    EXPECT_NE(error.find(known), std::string::npos);
}

TEST(Import, a_missing_file_and_a_folder_are_refused) {
  EXPECT_THROW(import_model({"/nonexistent/model.obj"}), Error);
  for (const char* name : {"folder.obj", "folder.ply", "folder.stl", "folder.gltf", "folder.glb"}) {
    const auto folder = std::filesystem::path(testing::TempDir()) / name;
    make_folder(folder);
    EXPECT_THROW(import_model({folder}), Error) << name;
  }
}

TEST(Import, an_empty_file_of_any_format_is_refused) {
  for (const char* name : {"empty.obj", "empty.ply", "empty.stl", "empty.gltf", "empty.glb"}) {
    EXPECT_NE(import_error(name, ""), "") << name;
  }
  EXPECT_EQ(import_error("empty.obj", ""), "holds no triangles");
}

TEST(Import, several_files_make_one_model_and_extensions_may_be_capitals) {
  const auto first = write_model("a.OBJ", square_obj), second = write_model("b.obj", square_obj);
  const Model model = import_model({first, second});
  EXPECT_EQ(model.meshes.size(), 2u);
  EXPECT_EQ(model.instances.size(), 2u);
  EXPECT_EQ(model.placed_triangles(), 4u);
}

TEST(Import, one_empty_file_among_good_ones_is_an_error) {
  EXPECT_THROW(import_model({write_model("a.obj", square_obj), write_model("b.obj", "v 0 0 0\n")}), Error);
}

TEST(ImportObj, faces_of_many_corners_become_triangles_and_doubles_stay_exact) {
  const Model model =
      import_text("a.obj", "v 0.1 1e-300 123456789.123456789\nv +1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  ASSERT_EQ(model.meshes.size(), 1u);
  EXPECT_EQ(model.meshes[0].positions[0], glm::dvec3(0.1, 1e-300, 123456789.123456789));
  EXPECT_EQ(model.meshes[0].triangles[1].vertices, (std::array<uint32_t, 3>{0, 2, 3}));
}

TEST(ImportObj, objects_and_groups_become_meshes_with_the_vertices_that_they_use) {
  const Model model = import_text(
      "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 5 5\no one\ng empty\ng left\nf 1 2 3\ng right\nf -1 -2 -3\n");
  ASSERT_EQ(model.meshes.size(), 2u);
  EXPECT_EQ(model.meshes[0].name, "left");
  EXPECT_EQ(model.meshes[1].name, "right");
  EXPECT_EQ(model.meshes[1].positions, (std::vector<glm::dvec3>{{5, 5, 5}, {0, 1, 0}, {1, 0, 0}}));
}

TEST(ImportObj, windows_lines_continued_lines_and_vertices_that_follow_their_faces_are_read) {
  const Model model = import_text("a.obj", "f 1 2 \\\r\n 3\r\nv 0 0 0\r\nv 1 0 0\r\nv 0 1 0 # last\r\n");
  EXPECT_EQ(model.source_triangles(), 1u);
}

TEST(ImportObj, a_damaged_face_or_vertex_is_named_with_its_line_and_costs_only_itself) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  for (const auto& [damage, said] : std::vector<std::pair<std::string, std::string>>{
           {"f 1 2 900\n",
            "line 5 names vertex 900 of 3; triangles with vertices that are not there are dropped"},
           {"f 1 0 1\n",
            "1 faces cannot be read and were skipped; the first, in line 5, names vertex 0 of 3"},
           {"f 1 1 -4\nf 0 0 0\n",
            "2 faces cannot be read and were skipped; the first, in line 5, names vertex -4 of 3"},
           {"\nf 1 1 99999999999999\n", "in line 6, names vertex 99999999999999 of 3"},
           {"f 1 x 1\n", "in line 5, has \"x\" for a corner"},
           {"v 0 0\nf 1 2 4\n", "1 vertices lack three numbers, the first in line 5"},
           {"v 0,5 0 zero\nf 1 2 -1\n", "1 vertices lack three numbers, the first in line 5"}}) {
    const Model model = import_text("a.obj", triangle + damage);
    EXPECT_EQ(model.source_triangles(), 1u) << damage;
    EXPECT_TRUE(warns(model, said)) << damage;
  }
  EXPECT_EQ(import_error("a.obj", triangle + "f 1 2 4000000000\n"), "line 5: names vertex 4000000000 of 3");
}

TEST(ImportObj, materials_come_from_the_library_beside_the_file) {
  write_model("my colours.mtl",
              "newmtl red\nKd 1 0 0.25\nd 0.5\nnewmtl grey\nKd 0.5\nKe 1 0 0\nmap_Kd wood.png\n");
  const Model model = import_text(
      "a.obj", "mtllib my colours.mtl\n" + square_obj + "usemtl red\nf 1 2 3\nusemtl grey\nf 1 2 3\n");
  const auto color_of = [&](size_t triangle) {
    return model.materials[model.meshes[0].triangles[triangle].material].base_color;
  };
  EXPECT_EQ(color_of(0), Material().base_color);
  // Kd is what is displayed, base colours are linear.
  const auto is_near = [](const glm::vec4& a, const glm::vec4& b) { return glm::length(a - b) < 1e-6f; };
  EXPECT_TRUE(is_near(color_of(2), {1, 0, 0.0508761f, 0.5}));
  EXPECT_TRUE(is_near(color_of(3), {0.2140411f, 0.2140411f, 0.2140411f, 1}));
  EXPECT_TRUE(warns(model, "names wood.png"));
  EXPECT_EQ(model.materials[model.meshes[0].triangles[3].material].emission, glm::vec3(1, 0, 0));
}

TEST(ImportObj, materials_let_light_through_as_d_says_or_else_tr) {
  for (const auto& [glass, alpha] : {std::pair{"d 0.2", 0.2f},
                                     {"Tr 0.8", 0.2f},
                                     {"d 1.0\nTr 1.0", 1.0f},
                                     {"Tr 1.0\nd 1.0", 1.0f},
                                     {"Tr 0.3\nd 0.25", 0.25f}}) {
    write_model("glass.mtl", std::string("newmtl glass\nKd 0 1 0\n") + glass + "\nnewmtl other\n");
    const Model model = import_text("a.obj", "mtllib glass.mtl\nusemtl glass\n" + square_obj);
    EXPECT_FLOAT_EQ(model.materials[model.meshes[0].triangles[0].material].base_color.a, alpha) << glass;
  }
}

TEST(ImportObj, a_missing_library_a_missing_material_and_skipped_statements_are_warnings) {
  const Model model = import_text("a.obj", "mtllib none.mtl\nusemtl red\nl 1 2\nf 1 2\nbogus\n" + square_obj);
  EXPECT_EQ(model.source_triangles(), 2u);
  for (const char* warning :
       {"none.mtl", "material that no library", "lines or points", "fewer than three", "not understood"}) {
    EXPECT_TRUE(warns(model, warning)) << warning;
  }
}

TEST(ImportObj, triangles_that_are_not_finite_are_dropped_and_counted) {
  const Model model =
      import_text("a.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1e999 0 0\nf 1 2 3\nf 2 3 4\nf 5 3 4\n");
  EXPECT_EQ(model.report.dropped_triangles, 2u);
  EXPECT_TRUE(warns(model, "2 triangles were dropped"));
  EXPECT_EQ(model.meshes[0].positions, (std::vector<glm::dvec3>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(import_error("b.obj", "v nan 0 0\nf 1 1 1\n"),
            "holds no triangles: 1 triangles were dropped: their coordinates are not finite");
}

TEST(ImportObj, no_damage_makes_it_crash) { expect_robust("a.obj", square_obj); }

std::string binary_stl(uint32_t promised, int facets, float x = 1) {
  std::string bytes = "solid that is binary";
  bytes.resize(80);
  append(bytes, promised);
  for (int i = 0; i < facets; ++i) {
    for (const float value : {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, x, 0.f, 0.f, 0.f, 1.f, static_cast<float>(i)})
      append(bytes, value);
    append(bytes, uint16_t{0});
  }
  return bytes;
}

const std::string ascii_stl =
    "solid a thing\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 0.1\n "
    " endloop\n"
    " endfacet\nendsolid a thing\nSOLID other\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 "
    "0\nVERTEX 0 1 0\n"
    "ENDLOOP\nENDFACET\nENDSOLID\n";

TEST(ImportStl, the_size_tells_a_binary_file_even_if_it_begins_with_solid) {
  const Model model = import_text("a.stl", binary_stl(3, 3));
  EXPECT_EQ(model.source_triangles(), 3u);
  EXPECT_EQ(model.meshes[0].positions[8], glm::dvec3(0, 1, 2));
}

TEST(ImportStl, every_solid_of_an_ascii_file_becomes_a_mesh) {
  const Model model = import_text("a.stl", ascii_stl);
  ASSERT_EQ(model.meshes.size(), 2u);
  EXPECT_EQ(model.meshes[0].name, "a thing");
  EXPECT_EQ(model.meshes[0].positions[2], glm::dvec3(0, 1, 0.1));
}

TEST(ImportStl, of_a_file_of_another_length_than_it_says_the_facets_that_are_there_are_read) {
  const Model cut = import_text("a.stl", binary_stl(4, 3) + "cut");
  EXPECT_EQ(cut.source_triangles(), 3u);
  EXPECT_TRUE(warns(cut, "promises 4 facets, the file holds 3"));
  EXPECT_EQ(import_text("a.stl", binary_stl(0xffffffff, 1)).source_triangles(), 1u);
  EXPECT_EQ(import_text("a.stl", binary_stl(0, 2)).source_triangles(), 2u);
  const Model longer = import_text("a.stl", binary_stl(2, 2) + std::string(92, '\0'));
  EXPECT_EQ(longer.source_triangles(), 2u);
  EXPECT_TRUE(warns(longer, "92 bytes after the last facet were skipped"));
  EXPECT_EQ(import_error("a.stl", binary_stl(0, 0)), "holds no triangles");
}

TEST(ImportStl, colours_of_facets_are_read_in_both_dialects) {
  const auto colored = [](std::string bytes, uint16_t first, uint16_t second) {
    std::memcpy(bytes.data() + 84 + 48, &first, 2);
    std::memcpy(bytes.data() + 84 + 50 + 48, &second, 2);
    return import_text("a.stl", bytes);
  };
  const auto color_of = [](const Model& model, size_t i) {
    return model.materials[model.meshes[0].triangles[i].material].base_color;
  };
  const glm::vec4 red(1, 0, 0, 1), blue(0, 0, 1, 1);
  const Model viscam = colored(binary_stl(2, 2), 0x8000 | 31 << 10, 0);
  EXPECT_EQ(color_of(viscam, 0), red);
  EXPECT_EQ(color_of(viscam, 1), Material().base_color);
  std::string magics = binary_stl(2, 2);
  magics.replace(40, 10, std::string("COLOR=\0\0\xff\xff", 10));
  const Model of_object = colored(magics, 31, 0x8000);
  EXPECT_EQ(color_of(of_object, 0), red);
  EXPECT_EQ(color_of(of_object, 1), blue);
  EXPECT_TRUE(warns(colored(binary_stl(2, 2), 7, 8), "2 facets with an attribute"));
}

TEST(ImportStl, noise_and_other_text_are_refused) {
  EXPECT_NE(import_error("a.stl", "<html> no solid </html>").find("is not an STL file"), std::string::npos);
  std::string noise;
  for (int i = 0; i < 4096; ++i) noise.push_back(static_cast<char>(i));
  EXPECT_NE(import_error("noise.stl", noise).find("is not an STL file"), std::string::npos);
}

TEST(ImportStl, of_an_ascii_file_that_is_damaged_only_the_damaged_facets_are_lost) {
  const std::string cut = ascii_stl.substr(0, ascii_stl.rfind("VERTEX"));
  const Model model = import_text("a.stl", cut);
  EXPECT_EQ(model.source_triangles(), 1u);
  EXPECT_TRUE(warns(
      model, "1 facets without three corners of three numbers each were skipped, the first before line"));
  EXPECT_NE(import_error("a.stl", "solid\nvertex 0,5 0 0\nendsolid\n").find("1 facets without"),
            std::string::npos);
}

TEST(ImportStl, ascii_dialects_are_understood) {
  const std::string corners = "vertex 0 0 0 vertex 1 0 0\nvertex 0\n1 0\n";
  for (const std::string& text : {"\xef\xbb\xbfsolid a\nfacet normal 0 0 1 outer loop " + corners +
                                      "end loop\nend facet\nend solid a\n",
                                  "solid\nfacet\nouter loop\n" + corners + "endloop\nendfacet\n",
                                  "Solid a b c\ncolor 1 0 0\nfacet normal nan x y\nouter loop\n" + corners +
                                      "endfacet\nendsolid b\n"}) {
    const Model model = import_text("a.stl", text);
    EXPECT_EQ(model.source_triangles(), 1u) << text;
    EXPECT_EQ(model.meshes[0].positions[2], glm::dvec3(0, 1, 0)) << text;
  }
  const std::string four =
      "solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\n";
  EXPECT_EQ(import_text("a.stl", four).source_triangles(), 2u);
}

TEST(ImportStl, triangles_that_are_not_finite_are_dropped_and_counted) {
  std::string two = binary_stl(2, 2);
  const float infinite = std::numeric_limits<float>::infinity();
  std::memcpy(two.data() + 84 + 12, &infinite, sizeof(infinite));
  EXPECT_EQ(import_text("a.stl", two).report.dropped_triangles, 1u);
  EXPECT_EQ(import_error("a.stl", binary_stl(2, 2, std::numeric_limits<float>::quiet_NaN())),
            "holds no triangles: 2 triangles were dropped: their coordinates are not finite");
}

TEST(ImportStl, no_damage_makes_it_crash) {
  expect_robust("a.stl", ascii_stl);
  expect_robust("b.stl", binary_stl(2, 2));
}

}  // namespace
}  // namespace triptych
