// DXF: entities that are surfaces, blocks and their inserts, layers, colours, units.
#include "described.hpp"
#include "placed.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace triptych {
namespace {

using test::described;
using test::expect_robust;
using test::import_error;
using test::import_text;
using test::warns;

/// Pairs of code and value, separated by blanks, as a file.
std::string pairs(std::string_view text) {
  std::string file;
  for (const char letter : text) file += letter == ' ' ? '\n' : letter;
  return file + "\n";
}
std::string section(const std::string& name, const std::string& content) {
  return pairs("0 SECTION 2 " + name) + (content.empty() ? "" : pairs(content)) + pairs("0 ENDSEC");
}
std::string drawing(const std::string& entities, const std::string& blocks = "",
                    const std::string& layers = "", const std::string& header = "") {
  return section("HEADER", header) + section("TABLES", layers) + section("BLOCKS", blocks) +
         section("ENTITIES", entities) + pairs("0 EOF");
}

/// A triangle of x 0 to 2, y 0 to 1.
const std::string face = "0 3DFACE 8 0 10 0 20 0 30 0 11 2 21 0 31 0 12 0 22 1 32 0 13 0 23 1 33 0";
const std::string block = "0 BLOCK 2 T 10 0 20 0 30 0 " + face + " 0 ENDBLK";

/// In the drawing's own axes: z is up.
void expect_bounds(const Model& model, size_t triangles, const glm::dvec3& low, const glm::dvec3& high) {
  EXPECT_EQ(test::placed_triangles(model).size(), triangles);
  test::expect_box(model, {low.x, low.z, -high.y}, {high.x, high.z, -low.y}, 1e-9);
}

Model with_insert(const std::string& insert) {
  return import_text("a.dxf", drawing("0 INSERT 8 0 2 T " + insert, block));
}

TEST(ImportDxf, inserts_are_moved_scaled_turned_and_mirrored) {
  expect_bounds(with_insert("10 10 20 20 30 3"), 1, {10, 20, 3}, {12, 21, 3});
  expect_bounds(with_insert("10 10 20 20 30 3 41 2 42 4"), 1, {10, 20, 3}, {14, 24, 3});
  expect_bounds(with_insert("10 10 20 20 30 3 50 90"), 1, {9, 20, 3}, {10, 22, 3});
  expect_bounds(with_insert("10 10 20 20 30 3 41 -1"), 1, {8, 20, 3}, {10, 21, 3});
  // Seen from below: x to the left.
  expect_bounds(with_insert("10 10 20 20 30 3 210 0 220 0 230 -1"), 1, {-12, 20, -3}, {-10, 21, -3});
  // Along x: the object's axes are y, z and x.
  expect_bounds(with_insert("10 10 20 20 30 3 210 1 220 0 230 0"), 1, {3, 10, 20}, {3, 12, 21});
  expect_bounds(with_insert("41 0"), 1, {0, 0, 0}, {2, 1, 0});
}

TEST(ImportDxf, arrays_of_inserts_turn_with_them) {
  expect_bounds(with_insert("70 3 71 2 44 5 45 7"), 6, {0, 0, 0}, {12, 8, 0});
  expect_bounds(with_insert("70 3 44 5 50 90 41 2"), 3, {-1, 0, 0}, {0, 14, 0});
}

TEST(ImportDxf, blocks_in_blocks_have_base_points_and_a_block_in_itself_ends) {
  const std::string outer = block + " 0 BLOCK 2 U 10 1 20 1 30 1 0 INSERT 2 t 10 5 20 0 30 0 0 ENDBLK";
  expect_bounds(import_text("a.dxf", drawing("0 INSERT 2 U 10 100 20 0 30 0 41 2 42 2 43 2", outer)), 1,
                {108, -2, -2}, {112, 0, -2});
  const std::string itself = "0 BLOCK 2 T " + face + " 0 INSERT 2 T 10 1 0 ENDBLK";
  EXPECT_TRUE(warns(import_text("a.dxf", drawing("0 INSERT 2 T", itself)), "inserts within themselves"));
  EXPECT_NE(import_error("a.dxf", drawing("0 INSERT 2 GONE")).find("blocks that are not in the file"),
            std::string::npos);
}

TEST(ImportDxf, far_coordinates_keep_their_digits) {
  const std::string far =
      "0 3DFACE 8 0 10 2683121.25 20 1247456.65 30 0 11 2683125.25 21 1247456.65 31 0 12 "
      "2683125.25 22 1247456.85 32 0 13 2683121.25 23 1247456.85 33 0";
  expect_bounds(import_text("a.dxf", drawing(far)), 2, {2683121.25, 1247456.65, 0},
                {2683125.25, 1247456.85, 0});
}

TEST(ImportDxf, solids_polygon_meshes_polyfaces_and_meshes_are_surfaces) {
  const std::string corners = " 10 0 20 0 30 1 11 4 21 0 31 1 12 0 22 3 32 1 13 4 23 3 33 1";
  expect_bounds(import_text("a.dxf", drawing("0 SOLID" + corners)), 2, {0, 0, 1}, {4, 3, 1});
  expect_bounds(import_text("a.dxf", drawing("0 TRACE 39 2" + corners)), 12, {0, 0, 1}, {4, 3, 3});
  const auto vertex = [](const std::string& at) { return " 0 VERTEX 70 64 " + at; };
  const std::string four = vertex("10 0 20 0 30 0") + vertex("10 2 20 0 30 0") + vertex("10 0 20 3 30 0") +
                           vertex("10 2 20 3 30 5");
  expect_bounds(import_text("a.dxf", drawing("0 POLYLINE 70 16 71 2 72 2" + four + " 0 SEQEND")), 2,
                {0, 0, 0}, {2, 3, 5});
  const std::string faces =
      " 0 VERTEX 70 128 71 1 72 -2 73 4 74 3 0 VERTEX 70 128 71 1 72 2 0 VERTEX 70 128 71 9 72 1 73 2";
  const Model polyface = import_text("a.dxf", drawing("0 POLYLINE 70 64" + four + faces + " 0 SEQEND"));
  expect_bounds(polyface, 2, {0, 0, 0}, {2, 3, 5});
  EXPECT_TRUE(warns(polyface, "1 faces that name vertices which are not there"));
  expect_bounds(
      import_text("a.dxf", drawing("0 MESH 71 2 72 0 91 0 92 3 10 0 20 0 30 0 10 2 20 0 30 0 10 0 20 3 "
                                   "30 5 93 4 90 3 90 0 90 1 90 2 94 0")),
      1, {0, 0, 0}, {2, 3, 5});
  // A number that cannot be read names no vertex; one in place of a count ends the lists.
  const Model unreadable = import_text(
      "a.dxf",
      drawing("0 MESH 71 2 72 0 91 0 92 3 10 0 20 0 30 0 10 2 20 0 30 0 10 0 20 3 30 5 93 13 90 3 90 0 "
              "90 nan 90 2 90 3 90 0 90 1 90 2 90 1e300 90 3 90 0 90 1 90 2 94 0"));
  expect_bounds(unreadable, 1, {0, 0, 0}, {2, 3, 5});
  EXPECT_TRUE(warns(unreadable, "1 faces that name vertices which are not there"));
  EXPECT_TRUE(warns(unreadable, "1 lists of faces end too soon"));
}

TEST(ImportDxf, curves_with_a_thickness_or_width_are_surfaces_and_others_are_counted) {
  expect_bounds(import_text("a.dxf", drawing("0 LINE 39 3 10 0 20 0 30 1 11 4 21 0 31 1")), 2, {0, 0, 1},
                {4, 0, 4});
  expect_bounds(import_text("a.dxf", drawing("0 LWPOLYLINE 38 1 39 3 70 1 10 0 20 0 10 4 20 0 10 4 20 2")), 6,
                {0, 0, 1}, {4, 2, 4});
  expect_bounds(import_text("a.dxf", drawing("0 LWPOLYLINE 43 2 10 0 20 0 10 4 20 0")), 2, {0, -1, 0},
                {4, 1, 0});
  expect_bounds(import_text("a.dxf", drawing("0 LWPOLYLINE 39 5 43 2 10 0 20 0 10 4 20 0 10 4 20 4")), 20,
                {0, -1, 0}, {5, 4, 5});
  const test::Box half =
      test::box_of(import_text("a.dxf", drawing("0 LWPOLYLINE 39 1 10 0 20 0 42 1 10 2 20 0")));
  EXPECT_NEAR(-half.second.z, -1, 1e-3);  // a bulge of 1 is a half circle to the right
  const test::Box circle = test::box_of(import_text("a.dxf", drawing("0 CIRCLE 39 2 10 1 20 1 30 0 40 3")));
  EXPECT_NEAR(circle.first.x, -2, 1e-2);
  EXPECT_NEAR(circle.second.y, 2, 1e-12);
  const Model counted =
      import_text("a.dxf", drawing(face + " 0 LINE 10 0 11 1 0 TEXT 1 hello 0 3DSOLID 1 x 0 NEW"));
  for (const char* kind : {"1 LINE", "1 TEXT", "1 3DSOLID", "1 NEW"})
    EXPECT_TRUE(warns(counted, kind)) << kind;
}

TEST(ImportDxf, layers_that_are_off_or_frozen_are_not_drawn_and_said) {
  const std::string layers = "0 TABLE 2 LAYER 0 LAYER 2 Off 70 0 62 -3 0 LAYER 2 Ice 70 1 62 3 0 ENDTAB";
  const std::string off = "0 3DFACE 8 off 10 50 20 0 30 0 11 51 21 0 31 0 12 51 22 1 32 0";
  const Model model =
      import_text("a.dxf", drawing(face + " " + off + " 0 INSERT 8 Ice 2 T 10 90", block, layers));
  expect_bounds(model, 1, {0, 0, 0}, {2, 1, 0});
  EXPECT_TRUE(warns(model, "1 faces and inserts on the layer \"Off\" are not drawn, since it is off"));
  EXPECT_TRUE(warns(model, "on the layer \"Ice\" are not drawn, since it is frozen"));
  // The content of a block on layer 0 is on its insert's layer.
  EXPECT_NE(import_error("a.dxf", drawing("0 INSERT 8 Off 2 T", block, layers)), "");
}

TEST(ImportDxf, colours_are_the_entitys_the_layers_or_the_inserts) {
  const std::string layers = "0 LAYER 2 Red 62 1 0 LAYER 2 True 62 7 420 255";
  const auto color_of = [&](const std::string& entity, const std::string& with_block = "") {
    const Model model = import_text("a.dxf", drawing(entity, with_block, layers));
    return model.materials[model.meshes[0].triangles[0].material].base_color;
  };
  const auto colored = [](const std::string& style) {
    return "0 3DFACE " + style + " 10 0 20 0 30 0 11 2 21 0 31 0 12 0 22 1 32 0";
  };
  const glm::vec4 red(1, 0, 0, 1), green(0, 1, 0, 1), blue(0, 0, 1, 1);
  EXPECT_EQ(color_of(colored("8 0 62 3")), green);
  EXPECT_EQ(color_of(colored("8 0 62 3 420 16711680")), red);
  EXPECT_EQ(color_of(colored("8 red")), red);
  EXPECT_EQ(color_of(colored("8 RED 62 256")), red);
  EXPECT_EQ(color_of(colored("8 True")), blue);
  EXPECT_EQ(color_of(colored("8 0")), Material().base_color);
  EXPECT_EQ(color_of(colored("8 0 62 90")), green);
  const auto in_block = [&](const std::string& style) {
    return "0 BLOCK 2 B " + colored(style) + " 0 ENDBLK";
  };
  EXPECT_EQ(color_of("0 INSERT 8 True 2 B 62 3", in_block("8 0 62 0")), green) << "by block";
  EXPECT_EQ(color_of("0 INSERT 8 True 2 B", in_block("8 0 62 0")), blue) << "by block, the insert by layer";
  EXPECT_EQ(color_of("0 INSERT 8 True 2 B 62 3", in_block("8 0")), blue) << "layer 0 is the insert's";
  EXPECT_EQ(color_of("0 INSERT 8 True 2 B 62 3", in_block("8 Red")), red);
}

TEST(ImportDxf, inserts_beyond_a_limit_are_counted_and_skipped) {
  ImportOptions options;
  options.max_placements = 100;
  const auto with = [&](const std::string& insert, const std::string& blocks) {
    return import_model({test::write_model("a.dxf", drawing(insert, blocks))}, options);
  };
  const Model hundred = with("0 INSERT 2 T 70 20 71 5 44 3 45 3", block);
  EXPECT_EQ(test::placed_triangles(hundred).size(), 100u);
  EXPECT_FALSE(warns(hundred, "were skipped"));
  const Model most = with("0 INSERT 2 T 70 1000000 71 1000000 44 3 45 3", block);
  EXPECT_EQ(test::placed_triangles(most).size(), 100u);
  EXPECT_TRUE(warns(most, "inserts beyond 100 were skipped"));
  // Inserts that place nothing count as well: within an array there may be many.
  const std::string holder = block + " 0 BLOCK 2 H 0 INSERT 2 T 0 INSERT 2 missing 0 ENDBLK";
  const Model nested = with("0 INSERT 2 H 70 1000000 44 3", holder);
  EXPECT_EQ(test::placed_triangles(nested).size(), 33u);
  EXPECT_TRUE(warns(nested, "33 inserts of blocks that are not in the file"));
}

TEST(ImportDxf, its_unit_is_that_of_the_header_unless_one_is_asked_for) {
  const std::string inches = drawing(face, "", "", "9 $ACADVER 1 AC1015 9 $INSUNITS 70 1");
  expect_bounds(import_text("a.dxf", inches), 1, {0, 0, 0}, {2 * 0.0254, 0.0254, 0});
  ImportOptions options;
  options.unit = LengthUnit::foot;
  options.up = UpAxis::z;
  const Model feet = import_model({test::write_model("a.dxf", inches)}, options);
  expect_bounds(feet, 1, {0, 0, 0}, {2 * 0.3048, 0.3048, 0});
  EXPECT_TRUE(warns(feet, "--unit was applied"));
  EXPECT_FALSE(warns(feet, "--up"));
  options.up = UpAxis::y;
  EXPECT_TRUE(warns(import_model({test::write_model("a.dxf", inches)}, options), "--up was not applied"));
}

/// The same groups as binary DXF, codes of two bytes, or of one as up to release 12.
std::string binary(const std::string& text, bool wide) {
  std::string bytes("AutoCAD Binary DXF\r\n\x1a\0", 22);
  std::istringstream lines(text);
  std::string code, value;
  while (std::getline(lines, code) && std::getline(lines, value)) {
    const int number = std::stoi(code);
    wide ? test::append(bytes, static_cast<int16_t>(number))
         : test::append(bytes, static_cast<uint8_t>(number));
    if (number >= 10 && number < 60) {
      test::append(bytes, std::stod(value));
    } else if (number >= 60 && number < 80) {
      test::append(bytes, static_cast<int16_t>(std::stoi(value)));
    } else {
      bytes += value + '\0';
    }
  }
  return bytes;
}

TEST(ImportDxf, binary_files_hold_the_same) {
  const std::string text = drawing("0 INSERT 8 0 2 T 10 10 20 20 30 3 62 1", block);
  for (const bool wide : {false, true})
    expect_bounds(import_text("a.dxf", binary(text, wide)), 1, {10, 20, 3}, {12, 21, 3});
}

TEST(ImportDxf, what_is_hidden_in_paper_space_or_external_is_counted) {
  const std::string external = "0 BLOCK 2 X 70 4 1 other.dwg 0 ENDBLK";
  const Model model = import_text(
      "a.dxf", drawing(face + " 0 3DFACE 60 1 10 0 0 3DFACE 67 1 10 0 0 INSERT 2 X 10 1", external));
  EXPECT_TRUE(warns(model, "entities that the drawing hides"));
  EXPECT_TRUE(warns(model, "entities of paper space"));
  EXPECT_TRUE(warns(model, "inserts of an external drawing were skipped; import it beside: X"));
}

TEST(ImportDxf, a_file_that_is_cut_keeps_what_stands_before_and_a_stray_line_shifts_nothing) {
  const std::string whole = drawing(face + " " + face);
  const Model cut = import_text("a.dxf", whole.substr(0, whole.size() - 30));
  EXPECT_GE(cut.source_triangles(), 1u);
  EXPECT_TRUE(warns(cut, "the file has no end"));
  const Model stray = import_text("a.dxf", pairs("999 made by hand 0 SECTION 2 ENTITIES") + "a stray line\n" +
                                               pairs(face + " 0 ENDSEC 0 EOF"));
  expect_bounds(stray, 1, {0, 0, 0}, {2, 1, 0});
  for (const std::string& none : {std::string(), std::string(3000, '\xff'), std::string("hello\nthere\n")})
    EXPECT_NE(import_error("a.dxf", none), "");
}

TEST(ImportDxf, no_damage_makes_it_crash) {
  const std::string text = drawing(
      "0 INSERT 2 T 70 2 0 POLYLINE 70 64 0 VERTEX 70 64 10 1 0 VERTEX 70 128 71 1 0 SEQEND 0 MESH 92 "
      "1 10 0 20 0 30 0 93 1 90 1 94 0 0 CIRCLE 39 1 40 1 0 LWPOLYLINE 43 1 10 0 20 0 42 1 10 1",
      block, "0 LAYER 2 A 62 1");
  expect_robust("a.dxf", text);
  expect_robust("a.dxf", binary(text, true));
}

TEST(ImportDxf, layers_of_the_model_space_and_inserts_are_objects) {
  const std::string outer = " 0 BLOCK 2 OUTER 10 0 20 0 30 0 0 INSERT 5 B2 8 0 2 T 10 5 20 0 0 ENDBLK";
  const Model model = import_text(
      "a.dxf",
      drawing(face +
                  " 0 INSERT 5 A1 8 walls 66 1 2 OUTER 0 ATTRIB 8 0 2 ROOM 1 12b 0 ATTRIB 8 0 2 USE 1 "
                  "office 0 SEQEND " +
                  face + " 0 ATTRIB 2 LOST 1 x",
              block + outer));
  EXPECT_EQ(described(model),
            (std::vector<std::string>{"0 (LAYER) layer 0", "OUTER > T (INSERT) layer walls number B2"}));
  EXPECT_EQ(described(model, model.source_objects.objects.back().parent),
            "OUTER (INSERT) layer walls number A1 {Attributes: ROOM=12b USE=office}");
}

}  // namespace
}  // namespace triptych
