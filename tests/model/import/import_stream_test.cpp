// Meshes that stay in their files: the same triangles as in memory, whatever the format; damage; memory.
#include "import_support.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <thread>

namespace triptych {
namespace {

using nlohmann::json;
using test::append;
using test::in_memory;
using test::streamed;
using test::triangles_of;
using test::write_model;

/// The file as a stream has the triangles that it has in memory, in the same order.
void expect_same_either_way(const std::filesystem::path& file, bool exact_count = true) {
  const Model expected = import_model({file}, in_memory), found = import_model({file}, streamed);
  ASSERT_EQ(found.meshes.size(), expected.meshes.size());
  for (size_t i = 0; i < found.meshes.size(); ++i) {
    ASSERT_FALSE(expected.meshes[i].stream);
    ASSERT_TRUE(found.meshes[i].stream);
    EXPECT_TRUE(found.meshes[i].positions.empty());
    EXPECT_EQ(found.meshes[i].name, expected.meshes[i].name);
    const auto triangles = triangles_of(found.meshes[i]);
    EXPECT_EQ(triangles, triangles_of(expected.meshes[i]));
    EXPECT_EQ(triangles, triangles_of(found.meshes[i])) << "a second reading differs";
    if (exact_count) {
      EXPECT_EQ(found.meshes[i].triangle_count(), triangles.size());
    }
  }
}

/// What reading the first mesh says; empty if nothing.
std::string reading_error(const std::filesystem::path& file) {
  const Model model = import_model({file}, streamed);
  try {
    triangles_of(model.meshes.at(0));
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find(file.string()), 0u) << message;
    return message.substr(std::min(message.size(), file.string().size() + 2));
  }
  return "";
}

constexpr uint32_t side = 90;  ///< vertices along a side of the square that most tests read

/// Faces of three, four and five corners over a square of side² vertices, some of them concave.
std::string grid_ply(bool big, bool mixed_types) {
  const uint32_t faces = (side - 1) * (side - 1);
  std::string bytes =
      std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\nelement vertex " +
      std::to_string(side * side) + "\n" +
      (mixed_types ? "property double z\nproperty uchar red\nproperty short x\nproperty float y\n"
                   : "property float x\nproperty float y\nproperty float z\n") +
      "element face " + std::to_string(faces) +
      (mixed_types ? "\nproperty uchar flags\nproperty list ushort int vertex_indices\nproperty "
                     "list uchar double weights\n"
                   : "\nproperty list uchar uint vertex_indices\n") +
      "end_header\n";
  for (uint32_t i = 0; i < side * side; ++i) {
    const auto x = static_cast<int16_t>(i % side), y = static_cast<int16_t>(i / side);
    if (mixed_types) {
      append(bytes, 0.1 * x, big);
      append(bytes, uint8_t{7}, big);
      append(bytes, x, big);
      append(bytes, static_cast<float>(y), big);
    } else {
      append(bytes, static_cast<float>(x), big);
      append(bytes, static_cast<float>(y), big);
      append(bytes, 0.5f * static_cast<float>(x), big);
    }
  }
  for (uint32_t i = 0; i < faces; ++i) {
    const uint32_t a = i / (side - 1) * side + i % (side - 1);
    std::vector<uint32_t> corners = {a, a + 1, a + side + 1};
    if (i % 3 > 0) corners.push_back(a + side);
    if (i % 3 > 1) corners = {a, a + 1, a, a + side + 1, a + side};
    if (mixed_types) {
      append(bytes, uint8_t{1}, big);
      append(bytes, static_cast<uint16_t>(corners.size()), big);
    } else {
      append(bytes, static_cast<uint8_t>(corners.size()), big);
    }
    for (const uint32_t corner : corners) append(bytes, corner, big);
    if (mixed_types) {
      append(bytes, uint8_t{1}, big);
      append(bytes, 0.5, big);
    }
  }
  return bytes;
}

TEST(ImportStream, a_ply_file_of_either_byte_order_streams_what_it_holds_in_memory) {
  for (const bool big : {false, true}) {
    expect_same_either_way(write_model("plain.ply", grid_ply(big, false)));
    expect_same_either_way(write_model("mixed.ply", grid_ply(big, true)), false);
  }
}

TEST(ImportStream, meshes_of_more_than_4096_triangles_stream_and_smaller_ones_until_there_are_many) {
  const auto large = write_model("large.ply", grid_ply(false, false));
  EXPECT_TRUE(import_model({large}).meshes[0].stream);
  EXPECT_FALSE(import_model({large}, {.stream_above = 100000}).meshes[0].stream);
  EXPECT_TRUE(import_model({large}, {.stream_above = 100000, .max_in_memory = 1000}).meshes[0].stream);
  const ImportOptions room_for_one = {.stream_above = 100000, .max_in_memory = 25000};
  const Model two = import_model({large, large}, room_for_one);
  EXPECT_FALSE(two.meshes[0].stream);
  EXPECT_TRUE(two.meshes[1].stream);
  EXPECT_EQ(two.source_triangles(), 2 * two.meshes[0].triangles.size());
}

TEST(ImportStream, damage_in_the_middle_of_a_ply_file_is_named_with_its_byte) {
  const std::string whole = grid_ply(false, false);
  const size_t faces = whole.find("end_header\n") + 11 + size_t{side} * side * 12;
  std::string damaged = whole;
  // The last face is a triangle or more: its last number lies at the end.
  const uint32_t beyond = side * side;
  std::memcpy(damaged.data() + damaged.size() - 4, &beyond, 4);
  EXPECT_NE(reading_error(write_model("index.ply", damaged)).find("a face's vertex is 8100"),
            std::string::npos);
  damaged = whole;
  damaged[faces] = static_cast<char>(200);
  EXPECT_EQ(reading_error(write_model("length.ply", damaged)).substr(0, 5), "byte ");
  EXPECT_NE(reading_error(write_model("cut.ply", whole.substr(0, whole.size() - 2))), "");
}

TEST(ImportStream, a_file_that_changes_between_readings_is_an_error) {
  const auto file = write_model("a.ply", grid_ply(false, false));
  const Model model = import_model({file}, streamed);
  EXPECT_NO_THROW(triangles_of(model.meshes[0]));
  std::filesystem::resize_file(file, 20000);
  EXPECT_THROW(triangles_of(model.meshes[0]), Error);
  std::filesystem::remove(file);
  EXPECT_THROW(triangles_of(model.meshes[0]), Error);
}

TEST(ImportStream, triangles_that_are_not_finite_are_counted_and_faces_of_two_corners_warned_of) {
  std::string bytes = grid_ply(false, false);
  const float bad = std::nanf("");
  std::memcpy(bytes.data() + bytes.find("end_header\n") + 11, &bad, sizeof(bad));  // vertex 0
  const size_t first_face = bytes.find("end_header\n") + 11 + size_t{side} * side * 12;
  const uint64_t all = triangles_of(import_model({write_model("a.ply", bytes)}, in_memory).meshes[0]).size();
  const Model model = import_model({write_model("a.ply", bytes)}, streamed);
  uint64_t found = 0;
  EXPECT_EQ(model.meshes[0].stream->read([&](auto batch) { found += batch.size(); }), 1u);
  EXPECT_EQ(found, all);
  ASSERT_EQ(model.meshes[0].stream->warnings().size(), 1u);
  EXPECT_NE(model.meshes[0].stream->warnings()[0].find("a.ply: 1 triangles were dropped"), std::string::npos);

  bytes[first_face] = 2;  // its third corner is the next face's length: 0 in its lowest byte, and so on
  bytes.erase(first_face + 9, 4);
  bytes += "tail";
  const Model two = import_model({write_model("b.ply", bytes)}, streamed);
  triangles_of(two.meshes[0]);
  const auto warnings = two.meshes[0].stream->warnings();
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[0].find("1 faces with fewer than three corners"), std::string::npos);
  EXPECT_NE(warnings[1].find("4 bytes after the last element"), std::string::npos);
}

TEST(ImportStream, a_face_of_more_corners_than_are_clipped_is_a_fan_of_any_size) {
  constexpr uint32_t corners = 100000;
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(corners) +
      "\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uint "
      "uint vertex_indices\nend_header\n";
  for (uint32_t i = 0; i < corners; ++i) {
    const double angle = 6.283185307179586 * i / corners;
    append(bytes, static_cast<float>(std::cos(angle)));
    append(bytes, static_cast<float>(std::sin(angle)));
    append(bytes, 0.f);
  }
  append(bytes, corners);
  for (uint32_t i = 0; i < corners; ++i) append(bytes, i);
  const auto file = write_model("disc.ply", bytes);
  expect_same_either_way(file);
  const Model model = import_model({file}, streamed);
  EXPECT_EQ(triangles_of(model.meshes[0]).size(), corners - 2);
  EXPECT_EQ(model.meshes[0].stream->warnings().size(), 1u);
}

TEST(ImportStream, what_the_reader_throws_passes_through_and_threads_read_side_by_side) {
  const Model model = import_model({write_model("a.ply", grid_ply(false, false))}, streamed);
  EXPECT_THROW(model.meshes[0].stream->read([](auto) { throw std::runtime_error("enough"); }),
               std::runtime_error);
  const auto expected = triangles_of(model.meshes[0]);
  std::vector<CornerTriangle> first, second;
  std::thread one([&] { first = triangles_of(model.meshes[0]); });
  second = triangles_of(model.meshes[0]);
  one.join();
  EXPECT_EQ(first, expected);
  EXPECT_EQ(second, expected);
}

TEST(ImportStream, a_binary_stl_file_streams_what_it_holds_in_memory) {
  std::string bytes(80, ' ');
  append(bytes, uint32_t{6000});
  for (int i = 0; i < 6000; ++i) {
    for (int k = 0; k < 12; ++k) append(bytes, static_cast<float>(i * k));
    append(bytes, static_cast<uint16_t>(i == 3));
  }
  const auto file = write_model("a.stl", bytes);
  expect_same_either_way(file);
  const Model model = import_model({file});
  EXPECT_EQ(triangles_of(model.meshes[0]).size(), 6000u);
  EXPECT_NE(model.meshes[0].stream->warnings().at(0).find("1 facets with an attribute"), std::string::npos);
}

/// Vertices on a curve, at a stride, and numbers of every width: lists, strips and fans, in one buffer.
json many_accessors(std::string& bytes) {
  constexpr uint32_t count = 240;
  for (uint32_t i = 0; i < count; ++i) {
    for (const float value :
         {0.1f * static_cast<float>(i), static_cast<float>(i % 7), static_cast<float>(i * i), -1.f})
      append(bytes, value);
  }
  for (uint32_t i = 0; i < 3 * count; ++i) append(bytes, static_cast<uint8_t>(i * 7 % count));
  for (uint32_t i = 0; i < 3 * count; ++i) append(bytes, static_cast<uint16_t>(i * 11 % count));
  for (uint32_t i = 0; i < 3 * count; ++i) append(bytes, i * 13 % count);
  for (uint32_t i = 0; i < 3 * count; ++i) append(bytes, static_cast<int16_t>(i * 91));
  json document =
      json::parse(R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "materials": [{}, {}]})");
  document["buffers"] = {{{"byteLength", bytes.size()}, {"uri", "many%20parts.bin"}}};
  document["bufferViews"] = {
      {{"buffer", 0}, {"byteLength", count * 16}, {"byteStride", 16}},
      {{"buffer", 0}, {"byteOffset", count * 16}, {"byteLength", bytes.size() - count * 16}}};
  const auto numbers = [&](int type, uint32_t offset) {
    return json{{"bufferView", 1},
                {"byteOffset", offset},
                {"componentType", type},
                {"count", 3 * count},
                {"type", "SCALAR"}};
  };
  document["accessors"] = {{{"bufferView", 0}, {"componentType", 5126}, {"count", count}, {"type", "VEC3"}},
                           numbers(5121, 0),
                           numbers(5123, 3 * count),
                           numbers(5125, 9 * count),
                           {{"bufferView", 1},
                            {"byteOffset", 21 * count},
                            {"componentType", 5122},
                            {"count", count},
                            {"type", "VEC3"},
                            {"normalized", true}}};
  json primitives = json::array();
  for (const int mode : {4, 5, 6}) {
    for (int indices = 1; indices < 4; ++indices) {
      primitives.push_back({{"attributes", {{"POSITION", mode == 5 ? 4 : 0}}},
                            {"indices", indices},
                            {"mode", mode},
                            {"material", indices % 2}});
    }
    primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"mode", mode}});
  }
  document["meshes"] = {{{"name", "many"}, {"primitives", primitives}}};
  return document;
}

TEST(ImportStream, gltf_lists_strips_and_fans_of_every_width_stream_what_they_hold_in_memory) {
  std::string bytes;
  const json document = many_accessors(bytes);
  write_model("many parts.bin", bytes);
  const auto file = write_model("a.gltf", document.dump());
  expect_same_either_way(file);
  const Model model = import_model({file}, streamed);
  EXPECT_EQ(model.source_triangles(), 3u * 240 + 80 + 6 * 718 + 2 * 238);
  EXPECT_NE(triangles_of(model.meshes[0]).front().material, triangles_of(model.meshes[0]).back().material);
}

TEST(ImportStream, a_sparse_accessor_keeps_its_mesh_in_memory_and_a_data_uri_streams_from_there) {
  std::string bytes;
  json document = many_accessors(bytes);
  write_model("many parts.bin", bytes);
  document["accessors"][0]["sparse"] = {{"count", 1},
                                        {"indices", {{"bufferView", 1}, {"componentType", 5121}}},
                                        {"values", {{"bufferView", 0}}}};
  const Model sparse = import_model({write_model("sparse.gltf", document.dump())}, streamed);
  EXPECT_FALSE(sparse.meshes[0].stream);
  const json embedded = json::parse(R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}]})");
  expect_same_either_way(write_model("embedded.gltf", embedded.dump()));
}

TEST(ImportStream, an_index_out_of_range_in_a_gltf_stream_is_named_with_its_primitive) {
  std::string bytes;
  const json document = many_accessors(bytes);
  bytes[240 * 16 + 100] = static_cast<char>(250);
  write_model("many parts.bin", bytes);
  EXPECT_EQ(reading_error(write_model("a.gltf", document.dump())),
            "mesh 0 primitive 0: index 100 names vertex 250 of 240");
}

TEST(ImportStream, many_small_files_take_no_descriptor_each) {
  std::vector<std::filesystem::path> files;
  const auto file = write_model("a.ply", grid_ply(false, false));
  for (int i = 0; i < 1500; ++i) files.push_back(file);
  const Model model = import_model(files, streamed);
  EXPECT_EQ(model.meshes.size(), 1500u);
  EXPECT_FALSE(triangles_of(model.meshes.back()).empty());
}

}  // namespace
}  // namespace triptych
