// What all readers of text share: byte order marks, line ends, numbers, names of other files.
#include "described.hpp"
#include "import_support.hpp"
#include "model/import/beside.hpp"
#include "model/import/import_reader.hpp"
#include "model/read_mesh.hpp"

#include <cmath>

namespace triptych {
namespace {

using test::described;
using test::import_error;
using test::import_text;
using test::warns;
using test::write_model;

std::vector<std::string> lines_of(const std::string& text) {
  ImportReader reader(write_model("lines.txt", text));
  std::vector<std::string> lines;
  for (std::string_view line; reader.next_line(line);) lines.emplace_back(line);
  EXPECT_EQ(reader.left(), 0u);
  return lines;
}

TEST(ImportText, lines_end_with_any_of_three_marks_and_a_byte_order_mark_is_no_letter) {
  const std::vector<std::string> expected = {"a", "", "b c"};
  EXPECT_EQ(lines_of("a\n\nb c\n"), expected);
  EXPECT_EQ(lines_of("a\r\n\r\nb c\r\n"), expected);
  EXPECT_EQ(lines_of("a\r\rb c\r"), expected);
  EXPECT_EQ(lines_of("\xef\xbb\xbf"
                     "a\r\n\nb c"),
            expected);
  EXPECT_TRUE(lines_of("\xef\xbb\xbf").empty());
  EXPECT_THROW(lines_of("\xff\xfe"
                        "a"),
               Error);
}

TEST(ImportText, lines_across_blocks_are_whole_whatever_ends_them) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string text;
    std::vector<std::string> expected;
    for (size_t i = 0; text.size() < 1'200'000; ++i) {
      expected.push_back(std::string(i % 97, 'x') + std::to_string(i));
      text += expected.back() + end;
    }
    EXPECT_EQ(lines_of(text), expected);
  }
}

TEST(ImportText, numbers_that_visual_c_wrote_are_no_numbers_but_no_error_either) {
  for (const char* word : {"1.#QNAN", "-1.#IND", "1.#INF", "nan", "-nan(ind)"}) {
    ASSERT_TRUE(to_number(word)) << word;
    EXPECT_FALSE(std::isfinite(*to_number(word)) && *to_number(word) != 0) << word;
  }
  EXPECT_FALSE(to_number("1,5"));
  EXPECT_FALSE(to_number("1.5x"));
}

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ImportText, an_unknown_statement_shifts_nothing_and_is_named) {
  const Model model = import_text("a.obj", "\xef\xbb\xbfv 0 0 0\nhello there\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
  EXPECT_EQ(model.source_triangles(), 1u);
  EXPECT_TRUE(warns(model, "1 statements \"hello\" are not understood"));
}

TEST(ImportText, a_backslash_continues_a_line_but_not_a_comment) {
  EXPECT_EQ(import_text("a.obj", "# C:\\models\\\n" + square + "f 1 2 \\\n3 4\n").source_triangles(), 2u);
}

glm::vec4 first_color(const std::string& obj) {
  const Model model = import_text("a.obj", obj);
  return model.materials[model.meshes[0].triangles[0].material].base_color;
}

TEST(ImportText, libraries_are_found_however_their_names_are_written) {
  write_model("Two Parts.MTL", "\xef\xbb\xbfnewmtl Material#25\nKd 1 0 0\n");
  const std::string faces = square + "usemtl Material#25\nf 1 2 3\n";
  for (const std::string name : {"Two Parts.MTL", "\"Two Parts.MTL\"", "two parts.mtl", ".\\Two Parts.MTL",
                                 "C:\\models\\two parts.mtl"})
    EXPECT_EQ(first_color("mtllib " + name + "\n" + faces), glm::vec4(1, 0, 0, 1)) << name;
  EXPECT_EQ(first_color(faces + "mtllib Two Parts.MTL\n"), glm::vec4(1, 0, 0, 1)) << "late";
  EXPECT_EQ(first_color(faces), Material().base_color);
}

TEST(ImportText, a_colour_that_cannot_be_read_loses_no_file) {
  write_model("bad.mtl", "newmtl a\nKd red\nnewmtl b\nKd 0 0 1\n");
  const Model model = import_text("a.obj", "mtllib bad.mtl\n" + square + "usemtl a\nf 1 2 3\n");
  EXPECT_TRUE(warns(model, "colours without three numbers"));
}

TEST(ImportText, colours_behind_the_vertices_of_an_obj_are_read) {
  const Model model = import_text("a.obj",
                                  "v 0 0 0 1 0.5 0\nv 1 0 0 1.0 1 0 0\nv 1 1 0 0 0 1\nv 0 1 0\n"
                                  "f 1 2 3\nf 1 3 4\no plain\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf 5 6 7\n");
  ASSERT_EQ(model.meshes.size(), 2u);
  EXPECT_EQ(model.meshes[0].colors,
            (std::vector<VertexColor>{{255, 128, 0, 255}, {255, 0, 0, 255}, {0, 0, 255, 255}, {}}))
      << "a fourth number before the colour is a weight, and a vertex may have none";
  EXPECT_TRUE(model.meshes[1].colors.empty());
  EXPECT_TRUE(model.report.warnings.empty());
}

TEST(ImportText, colours_of_an_obj_go_up_to_255_where_one_of_them_is_far_above_1) {
  const auto colors = [](const std::string& second) {
    const std::string text = "v 0 0 0 0 1 0.2\nv 1 0 0 " + second + "\nv 0 1 0\nf 1 2 3\n";
    const Model held = import_text("a.obj", text),
                streamed = import_text("a.obj", text, {.max_in_memory = 0});
    EXPECT_TRUE(streamed.meshes[0].stream);
    const auto triangle = [](const Model& model) {
      std::vector<CornerTriangle> all;
      read_mesh(model.meshes.at(0), [&](std::span<const CornerTriangle> batch) {
        all.insert(all.end(), batch.begin(), batch.end());
      });
      return all.at(0).colors;
    };
    EXPECT_EQ(triangle(held), triangle(streamed));
    return triangle(held);
  };
  EXPECT_EQ(colors("200 100 50"), (CornerColors{VertexColor{0, 1, 0, 255}, {200, 100, 50, 255}, {}}));
  EXPECT_EQ(colors("200.4 99.6 300"), (CornerColors{VertexColor{0, 1, 0, 255}, {200, 100, 255, 255}, {}}));
  EXPECT_EQ(colors("1.00001 0.4 1.5"), (CornerColors{VertexColor{0, 255, 51, 255}, {255, 102, 255, 255}, {}}))
      << "brighter than white";
}

TEST(ImportText, an_obj_with_colours_is_the_same_in_memory_and_as_a_stream) {
  const std::string text = "v 0 0 0\nv 1 0 0 0.1 0.2 0.3\nv 1 1 0 1 1 1\nv 0 1 0 nan 0 0\nf 1 2 3\nf 1 3 4\n";
  const auto read = [](const Model& model) {
    std::vector<CornerTriangle> all;
    read_mesh(model.meshes.at(0), [&](std::span<const CornerTriangle> batch) {
      all.insert(all.end(), batch.begin(), batch.end());
    });
    return all;
  };
  const Model held = import_text("a.obj", text), streamed = import_text("a.obj", text, {.max_in_memory = 0});
  EXPECT_TRUE(streamed.meshes[0].stream);
  EXPECT_EQ(read(held), read(streamed));
  EXPECT_FALSE(is_colored(read(held)[1].colors[2])) << "no number is no colour";
}

TEST(ImportText, objects_and_groups_of_obj_and_solids_of_stl_are_objects) {
  const std::string face = "f 1 2 3\n";
  const std::string grouped = square + face + "o House\n" + face + "g Roof\n" + face + "g Door\n" + face +
                              "g Roof\n" + face + "o Shed\ng Roof\n" + face + "g\n" + face;
  const std::vector<std::string> expected = {"none",         "House",       "House > Roof", "House > Door",
                                             "House > Roof", "Shed > Roof", "Shed"};
  const Model model = import_text("a.obj", grouped);
  EXPECT_EQ(described(model), expected);
  EXPECT_EQ(model.instances[2].object, model.instances[4].object) << "the same group again";
  ImportOptions streamed;
  streamed.max_in_memory = 0;
  EXPECT_EQ(described(import_model({write_model("b.obj", grouped)}, streamed)), expected);
  EXPECT_TRUE(import_text("c.obj", square + face).source_objects.empty());
  EXPECT_EQ(described(import_text("a.stl",
                                  "solid my part\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 "
                                  "0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n")),
            (std::vector<std::string>{"my part"}));
}

}  // namespace
}  // namespace triptych
