#include "import_support.hpp"
#include "model/read_mesh.hpp"

namespace triptych {
namespace {

using test::append;
using test::expect_robust;
using test::import_error;
using test::import_text;
using test::warns;

const std::string ascii_ply =
    "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 4\nproperty double x\nproperty double "
    "y\nproperty double z\n"
    "property uchar red\nproperty list uchar float weights\nelement extra 1\nproperty int a\nelement face 1\n"
    "property list uchar int vertex_indices\nproperty uchar flags\nend_header\n"
    "0.1 0 0 255 2 0.5 0.5\n1 0 0 255 0\n1 1 0 0 0\n\n0 1 0 0 0\n7\n4 0 1 2 3 9\n";

/// A square in binary, its vertices in doubles, with lists and elements that are to be skipped.
std::string binary_ply(bool big) {
  std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                      "_endian 1.0\nelement skipped 1\nproperty list short double values\nelement vertex 4\n"
                      "property float64 y\nproperty float64 x\nproperty char tag\nproperty float64 z\n"
                      "element face 1\nproperty list uint8 uint32 vertex_index\nend_header\n";
  append(bytes, int16_t{2}, big);
  append(bytes, 1.5, big);
  append(bytes, 2.5, big);
  for (int i = 0; i < 4; ++i) {
    append(bytes, i * 0.1, big);
    append(bytes, i + 0.5, big);
    append(bytes, int8_t{-1}, big);
    append(bytes, -7.0, big);
  }
  append(bytes, uint8_t{4}, big);
  for (const uint32_t i : {0u, 1u, 2u, 3u}) append(bytes, i, big);
  return bytes;
}

TEST(ImportPly, an_ascii_file_is_read_with_its_doubles_and_what_is_not_drawn_is_said) {
  const Model model = import_text("a.ply", ascii_ply);
  EXPECT_EQ(model.source_triangles(), 2u);
  EXPECT_EQ(model.meshes[0].positions[0], glm::dvec3(0.1, 0, 0));
  EXPECT_EQ(model.meshes[0].positions[3], glm::dvec3(0, 1, 0));
  EXPECT_TRUE(model.meshes[0].colors.empty()) << "red alone is no colour";
  EXPECT_TRUE(warns(model, "1 records of the element \"extra\""));
  EXPECT_TRUE(warns(model, "properties of \"vertex\" are not used: red weights"));
  EXPECT_TRUE(warns(model, "properties of \"face\" are not used: flags"));
}

TEST(ImportPly, both_byte_orders_give_the_same_doubles) {
  for (const bool big : {false, true}) {
    const Model model = import_text("a.ply", binary_ply(big));
    ASSERT_EQ(model.source_triangles(), 2u);
    for (int i = 0; i < 4; ++i)
      EXPECT_EQ(model.meshes[0].positions[static_cast<size_t>(i)], glm::dvec3(i + 0.5, i * 0.1, -7));
    EXPECT_EQ(model.meshes[0].triangles[1].vertices, (std::array<uint32_t, 3>{0, 2, 3}));
  }
}

std::string ascii_triangle(const std::string& channels, const std::string& colors) {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n" +
         channels + "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 " + colors +
         "\n1 0 0 " + colors + "\n0 1 0 " + colors + "\n3 0 1 2\n";
}

TEST(ImportPly, colours_of_vertices_are_read_whatever_their_type_and_the_order_of_channels) {
  const auto color = [](const std::string& channels, const std::string& colors) {
    const Model model = import_text("a.ply", ascii_triangle(channels, colors));
    EXPECT_EQ(model.meshes.at(0).colors.size(), 3u);
    EXPECT_TRUE(model.report.warnings.empty());
    return model.meshes.at(0).colors.at(1);
  };
  const auto named = [](const std::string& type, std::initializer_list<const char*> names) {
    std::string properties;
    for (const char* name : names) properties += "property " + type + " " + name + "\n";
    return properties;
  };
  const VertexColor wanted{255, 51, 0, 255};
  EXPECT_EQ(color(named("uchar", {"red", "green", "blue"}), "255 51 0"), wanted);
  EXPECT_EQ(color(named("uint8", {"alpha", "blue", "green", "red"}), "9 0 51 255"), wanted);
  EXPECT_EQ(color(named("float", {"red", "green", "blue", "alpha"}), "1 0.2 0 0.5"), wanted);
  EXPECT_EQ(color(named("float", {"r", "g", "b"}), "7.5 0.2 -1"), wanted) << "what is beyond is clamped";
  EXPECT_EQ(color(named("ushort", {"red", "green", "blue"}), "65535 13107 0"), wanted);
  EXPECT_EQ(color(named("int", {"red", "green", "blue"}), "255 51 0"), wanted);
  EXPECT_EQ(color(named("uchar", {"diffuse_red", "diffuse_green", "diffuse_blue"}), "255 51 0"), wanted);
}

TEST(ImportPly, colours_are_the_same_from_memory_from_a_stream_and_from_the_file_in_place) {
  for (const bool big : {false, true}) {
    std::string bytes =
        std::string("ply\nformat binary_") + (big ? "big" : "little") +
        "_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "property ushort red\nproperty ushort green\nproperty ushort blue\n"
        "element face 1\nproperty list uint8 uint32 vertex_index\nend_header\n";
    for (int i = 0; i < 4; ++i) {
      for (const float value : {static_cast<float>(i % 2), static_cast<float>(i / 2), 0.0f})
        append(bytes, value, big);
      for (const int channel : {20000 * i, 65535 - 9000 * i, 257 * i})
        append(bytes, static_cast<uint16_t>(channel), big);
    }
    append(bytes, uint8_t{4}, big);
    for (const uint32_t i : {0u, 1u, 3u, 2u}) append(bytes, i, big);
    const auto read = [](const Model& model) {
      std::vector<CornerTriangle> all;
      read_mesh(model.meshes.at(0), [&](std::span<const CornerTriangle> batch) {
        all.insert(all.end(), batch.begin(), batch.end());
      });
      return all;
    };
    const Model held = import_text("a.ply", bytes),
                streamed = import_text("b.ply", bytes, {.stream_above = 0}),
                stored = import_text("c.ply", bytes, {.held_bytes = 0});
    EXPECT_TRUE(held.meshes[0].has_colors() && streamed.meshes[0].has_colors() &&
                stored.meshes[0].has_colors());
    EXPECT_FALSE(held.meshes[0].stream);
    EXPECT_TRUE(streamed.meshes[0].stream && stored.meshes[0].stream);
    EXPECT_EQ(read(held), read(streamed));
    EXPECT_EQ(read(held), read(stored));
    EXPECT_EQ(read(held)[0].colors[1], (VertexColor{78, 220, 1, 255}));
  }
}

/// Two triangles of a square in two colours, and a third one in the first colour again; the colours stand
/// before and behind the corners.
std::string colored_faces(const std::string& format, const std::string& type = "uchar") {
  return "ply\nformat " + format +
         " 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n" +
         "element face 3\nproperty " + type + " blue\nproperty list uchar int vertex_indices\nproperty " +
         type + " red\nproperty list uchar uchar marks\nproperty " + type + " green\nend_header\n";
}

std::vector<CornerTriangle> read_all(const Model& model) {
  std::vector<CornerTriangle> all;
  read_mesh(model.meshes.at(0), [&](std::span<const CornerTriangle> batch) {
    all.insert(all.end(), batch.begin(), batch.end());
  });
  return all;
}

void expect_colored_faces(const Model& model) {
  const std::vector<CornerTriangle> triangles = read_all(model);
  const VertexColor first{200, 100, 50, 255}, second{1, 2, 3, 255};
  ASSERT_EQ(triangles.size(), 3u);
  EXPECT_TRUE(model.meshes[0].has_colors());
  for (size_t i = 0; i < 3; ++i) {
    const VertexColor& wanted = i == 1 ? second : first;
    EXPECT_EQ(triangles[i].colors, (CornerColors{wanted, wanted, wanted})) << i;
    EXPECT_EQ(triangles[i].material, 0u);
  }
  for (const std::string& warning : model.report.warnings)
    EXPECT_NE(warning.find("properties of \"face\" are not used: marks"), std::string::npos) << warning;
}

TEST(ImportPly, colours_of_faces_are_drawn_whatever_their_encoding_and_wherever_the_mesh_is_kept) {
  const std::string vertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  const std::string text =
      colored_faces("ascii") + vertices + "50 3 0 1 2 200 0 100\n3 3 0 2 3 1 2 8 9 2\n50 3 1 2 3 200 0 100\n";
  ImportOptions spooled;
  spooled.max_in_memory = 0;
  const Model held = import_text("a.ply", text), in_file = import_text("b.ply", text, spooled);
  EXPECT_FALSE(held.meshes[0].stream);
  EXPECT_EQ(held.meshes[0].positions.size(), 8u)
      << "shared by faces of one colour as far as they follow each other";
  EXPECT_TRUE(in_file.meshes[0].stream);
  expect_colored_faces(held);
  expect_colored_faces(in_file);
  for (const bool big : {false, true}) {
    std::string bytes = colored_faces(big ? "binary_big_endian" : "binary_little_endian", "ushort");
    for (const int value : {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0})
      append(bytes, static_cast<float>(value), big);
    for (const auto& [corners, color, marks] : {std::tuple(std::array{0, 1, 2}, std::array{200, 100, 50}, 0),
                                                {{0, 2, 3}, {1, 2, 3}, 2},
                                                {{1, 2, 3}, {200, 100, 50}, 0}}) {
      append(bytes, static_cast<uint16_t>(257 * color[2]), big);
      append(bytes, uint8_t{3}, big);
      for (const int corner : corners) append(bytes, corner, big);
      append(bytes, static_cast<uint16_t>(257 * color[0]), big);
      append(bytes, static_cast<uint8_t>(marks), big);
      bytes.append(static_cast<size_t>(marks), '\7');
      append(bytes, static_cast<uint16_t>(257 * color[1]), big);
    }
    expect_colored_faces(import_text("c.ply", bytes));
    const Model streamed = import_text("d.ply", bytes, test::streamed);
    EXPECT_TRUE(streamed.meshes[0].stream);
    expect_colored_faces(streamed);
    if (!big) expect_robust("e.ply", bytes);
  }
}

TEST(ImportPly, colours_of_vertices_come_before_those_of_faces) {
  std::string text =
      ascii_triangle("property uchar red\nproperty uchar green\nproperty uchar blue\n", "9 8 7");
  text.replace(text.find("end_header"), 0, "property uchar red\nproperty uchar green\nproperty uchar blue\n");
  text.replace(text.find("3 0 1 2"), 7, "3 0 1 2 100 100 100");
  const Model model = import_text("a.ply", text);
  EXPECT_EQ(read_all(model).at(0).colors[0], (VertexColor{9, 8, 7, 255}));
  EXPECT_TRUE(warns(model, "properties of \"face\" are not used: red green blue"));
}

TEST(ImportPly, a_promise_of_more_than_the_file_holds_is_refused_at_once) {
  const std::string xyz = "property float x\nproperty float y\nproperty float z\nend_header\n";
  for (const char* count : {"1000000000", "9223372036854775807"}) {
    for (const char* format : {"binary_little_endian", "binary_big_endian", "ascii"}) {
      const std::string file =
          std::string("ply\nformat ") + format + " 1.0\nelement vertex " + count + "\n" + xyz;
      EXPECT_NE(import_error("promise.ply", file).find("promises"), std::string::npos) << format;
    }
  }
  EXPECT_NE(import_error("a.ply", "ply\nformat ascii 1.0\nelement face 99999999999999999999\nend_header\n")
                .substr(0, 6),
            "");
  EXPECT_NE(
      import_error("a.ply", "ply\nformat binary_little_endian 1.0\nelement nothing 1000000000\nend_header\n")
          .find("no properties"),
      std::string::npos);
}

TEST(ImportPly, a_list_longer_than_the_file_is_refused_before_it_is_made) {
  std::string file =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty char x\nproperty char y\nproperty "
      "char z\n"
      "element face 1\nproperty list uint int vertex_indices\nend_header\n123";
  append(file, uint32_t{0xffffffff});
  EXPECT_NE(import_error("a.ply", file).find("the file ends within a list of 4294967295 values"),
            std::string::npos);
}

TEST(ImportPly, an_index_out_of_range_is_refused_with_its_place) {
  std::string wrong = ascii_ply;
  wrong.replace(wrong.find("4 0 1 2 3 9"), 11, "4 0 1 2 4 9");
  EXPECT_EQ(import_error("a.ply", wrong), "line 22: a face's vertex is 4, and must be from 0 to 3");
  wrong.replace(wrong.find("4 0 1 2 4 9"), 11, "4 0 1 2 -1 9");
  EXPECT_EQ(import_error("a.ply", wrong).substr(0, 8), "line 22:");
  std::string binary = binary_ply(false);
  binary[binary.size() - 4] = 4;
  EXPECT_NE(import_error("b.ply", binary).find("byte "), std::string::npos);
}

TEST(ImportPly, too_few_or_too_many_values_are_refused) {
  std::string wrong = ascii_ply;
  EXPECT_NE(import_error("a.ply", wrong.replace(wrong.find("1 1 0 0 0"), 9, "1 1 0 0 0 5")), "");
  wrong = ascii_ply;
  EXPECT_NE(import_error("a.ply", wrong.replace(wrong.find("1 1 0 0 0"), 9, "1 1 0 0")), "");
  // Normals that the header does not name: every second vertex would be one of them.
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  EXPECT_NE(import_error("a.ply", header + "0 0 0 0 0 1\n1 0 0 0 0 1\n3 1 2 0 0 1\n3 0 1 2\n"), "");
  EXPECT_EQ(import_text("a.ply", header + "0 0 0 1 0 0\n0 1 0 3 0 1\n2\n").source_triangles(), 1u);
}

TEST(ImportPly, a_file_cut_in_half_is_refused) {
  for (const std::string& file : {binary_ply(false), ascii_ply}) {
    EXPECT_NE(import_error("a.ply", file.substr(0, file.size() / 2)), "");
    EXPECT_NE(import_error("a.ply", file.substr(0, file.size() - 4)), "");
  }
}

TEST(ImportPly, point_clouds_are_refused) {
  const std::string points =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
      "z\nend_header\n0 0 0\n";
  EXPECT_EQ(import_error("a.ply", points), "holds no triangles: 1 points, which are not drawn");
}

TEST(ImportPly, triangle_strips_turn_every_second_triangle_and_end_with_minus_one) {
  const Model model = import_text(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n9 0 1 2 3 -1\n0 1 2 2\n");
  const auto triangles = test::triangles_of(model.meshes[0]);
  ASSERT_EQ(triangles.size(), 3u);  // the one with a corner twice joins two strips
  for (const CornerTriangle& triangle : triangles) {
    const auto& c = triangle.corners;
    EXPECT_GT(glm::cross(c[1] - c[0], c[2] - c[0]).z, 0);
  }
}

TEST(ImportPly, records_go_over_lines_and_lines_end_as_they_like) {
  const std::string text =
      "\xef\xbb\xbfply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
      "float z\n"
      "shape round\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0\n0\n1 0 0\n0 1 "
      "0\n3 0\n1 2\n";
  for (const char* end : {"\n", "\r\n", "\r"}) {
    std::string other;
    for (const char letter : text) letter == '\n' ? other += end : other += letter;
    const Model model = import_text("a.ply", other);
    EXPECT_EQ(model.source_triangles(), 1u);
    EXPECT_TRUE(warns(model, "1 statements of the header are not understood"));
  }
}

TEST(ImportPly, binary_data_behind_a_header_of_carriage_returns_may_begin_with_a_newline) {
  std::string bytes =
      "ply\rformat binary_little_endian 1.0\relement face 1\rproperty list uchar uchar vertex_indices\r"
      "property uchar first\relement vertex 3\rproperty uchar x\rproperty uchar y\rproperty uchar "
      "z\rend_header\r";
  const size_t list = bytes.find("property list"), first = bytes.find("property uchar first");
  bytes = bytes.substr(0, list) + bytes.substr(first, 21) + bytes.substr(list, first - list) +
          bytes.substr(first + 21);
  bytes += std::string("\n\3\0\1\2\0\0\0\1\0\0\0\1\0", 14);
  EXPECT_EQ(import_text("a.ply", bytes).source_triangles(), 1u);
}

TEST(ImportPly, a_vertex_without_a_coordinate_or_a_face_without_its_list_is_refused) {
  EXPECT_NE(
      import_error(
          "a.ply",
          "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nelement face 1\n"
          "property list uchar int vertex_indices\nend_header\n0 0\n3 0 0 0\n")
          .find("\"z\""),
      std::string::npos);
  EXPECT_NE(
      import_error(
          "a.ply",
          "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
          "element face 1\nproperty int a\nend_header\n0 0 0\n3\n")
          .find("vertex_indices"),
      std::string::npos);
}

TEST(ImportPly, no_damage_makes_it_crash) {
  expect_robust("a.ply", ascii_ply);
  expect_robust("b.ply", binary_ply(false));
  expect_robust("c.ply", binary_ply(true));
}

}  // namespace
}  // namespace triptych
