#include "gltf_support.hpp"
#include "model/read_mesh.hpp"

#include <cmath>
#include <glm/vec4.hpp>

namespace triptych {
namespace {

using nlohmann::json;
using test::append;
using test::expect_robust;
using test::glb;
using test::import_error;
using test::import_json;
using test::import_text;
using test::json_error;
using test::square;
using test::square_bytes;
using test::warns;
using test::write_model;

TEST(ImportGltf, a_mesh_comes_with_its_positions_triangles_and_base_colour) {
  const Model model = import_json(square());
  ASSERT_EQ(model.meshes.size(), 1u);
  EXPECT_EQ(model.meshes[0].name, "square");
  EXPECT_EQ(model.meshes[0].positions, (std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}));
  ASSERT_EQ(model.meshes[0].triangles.size(), 2u);
  EXPECT_EQ(model.meshes[0].triangles[1].vertices, (std::array<uint32_t, 3>{2, 1, 3}));
  EXPECT_EQ(model.materials[model.meshes[0].triangles[0].material].base_color, glm::vec4(0.5, 0.25, 1, 1))
      << "without an alphaMode it is opaque, whatever its alpha";
  EXPECT_TRUE(model.report.warnings.empty());
  json document = square();
  document["materials"][0]["alphaMode"] = "BLEND";
  EXPECT_EQ(import_json(document).materials.back().base_color, glm::vec4(0.5, 0.25, 1, 0.75));
  for (const auto& [cutoff, alpha] : {std::pair{0.7, 1.0f}, {0.8, 0.0f}}) {
    document["materials"][0]["alphaMode"] = "MASK";
    document["materials"][0]["alphaCutoff"] = cutoff;
    EXPECT_EQ(import_json(document).materials.back().base_color.a, alpha) << "it is there or not";
  }
}

TEST(ImportGltf, transforms_are_composed_in_double_down_the_tree) {
  json document = square();
  document["nodes"] = json::parse(R"([
    {"translation": [1e9, 0.1, 0], "children": [1, 2]},
    {"mesh": 0, "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476], "scale": [2, 3, 4]},
    {"mesh": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,-1,0, 1e-7,0,0,1]}])");
  const Model model = import_json(document);
  ASSERT_EQ(model.instances.size(), 2u);
  EXPECT_EQ(model.meshes.size(), 1u);
  const glm::dvec3 turned = model.instances[0].transform * glm::dvec4(1, 1, 1, 1);
  EXPECT_NEAR(turned.x, 1e9 - 3, 1e-6);
  EXPECT_NEAR(turned.y, 2.1, 1e-12);
  EXPECT_NEAR(turned.z, 4, 1e-12);
  EXPECT_EQ(model.instances[1].transform[3], glm::dvec3(1e9 + 1e-7, 0.1, 0));
  EXPECT_EQ(model.instances[1].transform[2], glm::dvec3(0, 0, -1));
}

TEST(ImportGltf, one_scene_is_placed_the_default_or_the_first_and_every_root_where_there_is_none) {
  json document = square();
  document["nodes"] = json::parse(R"([{"mesh": 0}, {"children": [2]}, {"mesh": 0}])");
  EXPECT_EQ(import_json(document).instances.size(), 1u);
  document["scenes"] = json::parse(R"([{"nodes": [0]}, {"nodes": [1]}])");
  document.erase("scene");
  const Model first = import_json(document);
  EXPECT_EQ(first.instances.size(), 1u);
  EXPECT_TRUE(warns(first, "1 scenes beside the one that is shown first were not imported"));
  document.erase("scenes");
  EXPECT_EQ(import_json(document).instances.size(), 2u);
}

TEST(ImportGltf, strips_and_fans_become_triangles_of_one_winding_and_points_are_skipped) {
  json document = square();
  document["meshes"][0]["primitives"] = json::parse(R"([
    {"attributes": {"POSITION": 0}, "mode": 5}, {"attributes": {"POSITION": 0}, "mode": 6},
    {"attributes": {"POSITION": 0}, "mode": 0}, {"attributes": {"POSITION": 0}, "mode": 1}])");
  const Model model = import_json(document);
  const auto& triangles = model.meshes[0].triangles;
  ASSERT_EQ(triangles.size(), 4u);
  EXPECT_EQ(triangles[0].vertices, (std::array<uint32_t, 3>{0, 1, 2}));
  EXPECT_EQ(triangles[1].vertices, (std::array<uint32_t, 3>{2, 1, 3}));
  EXPECT_EQ(triangles[3].vertices, (std::array<uint32_t, 3>{4, 6, 7}));
  EXPECT_TRUE(warns(model, "2 primitives of points or lines"));
  EXPECT_EQ(triangles[0].material, 0u);
}

TEST(ImportGltf, binary_files_and_embedded_buffers_give_the_same_mesh) {
  const Model expected = import_json(square());
  EXPECT_EQ(import_text("a.glb", glb(square(), square_bytes())).meshes[0].positions,
            expected.meshes[0].positions);
  json embedded = square();
  embedded["buffers"][0] = {
      {"byteLength", 36},
      {"uri", "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}};
  embedded["bufferViews"] = {{{"buffer", 0}, {"byteLength", 36}}};
  embedded["accessors"][0]["count"] = 3;
  embedded["accessors"].erase(1);
  embedded["meshes"][0]["primitives"][0].erase("indices");
  EXPECT_EQ(import_json(embedded).meshes[0].positions,
            (std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  embedded["buffers"][0]["byteLength"] = 360000000;
  EXPECT_NE(json_error(embedded), "");
}

TEST(ImportGltf, quantized_and_sparse_positions_are_read) {
  json document = square();
  document["accessors"][0] = {
      {"bufferView", 1}, {"componentType", 5122}, {"count", 2}, {"type", "VEC3"}, {"normalized", true}};
  document["accessors"][1]["count"] = 3;
  document["meshes"][0]["primitives"][0].erase("indices");
  document["meshes"][0]["primitives"][0]["mode"] = 5;
  EXPECT_EQ(json_error(document), "holds no triangles: 1 nodes place a mesh without triangles");
  document["accessors"][0] = {{"componentType", 5126},
                              {"count", 3},
                              {"type", "VEC3"},
                              {"sparse",
                               {{"count", 1},
                                {"indices", {{"bufferView", 1}, {"byteOffset", 4}, {"componentType", 5123}}},
                                {"values", {{"bufferView", 0}, {"byteOffset", 36}}}}}};
  EXPECT_EQ(import_json(document).meshes[0].positions,
            (std::vector<glm::dvec3>{{0, 0, 0}, {0, 0, 0}, {1, 1, 0}}));
  document["accessors"][0]["count"] = 2;
  EXPECT_NE(json_error(document).find("sparse indices"), std::string::npos);
  document["accessors"][0]["count"] = 4000000000;
  EXPECT_NE(json_error(document).find("without a buffer view"), std::string::npos);
  document["accessors"][0] = {
      {"bufferView", 1}, {"componentType", 5121}, {"count", 3}, {"type", "VEC3"}, {"normalized", true}};
  EXPECT_EQ(import_json(document).meshes[0].positions[0], glm::dvec3(0, 0, 1 / 255.0));
}

TEST(ImportGltf, instancing_on_the_card_places_every_instance) {
  json document = square();
  document["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  document["nodes"][0]["translation"] = {10, 0, 0};
  document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", 0},
                                                                                 {"SCALE", 0}};
  const Model model = import_json(document);
  ASSERT_EQ(model.instances.size(), 4u);
  EXPECT_EQ(model.instances[3].transform[3], glm::dvec3(11, 1, 0));
  EXPECT_EQ(model.instances[3].transform[0], glm::dvec3(1, 0, 0));
  document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", 7}};
  EXPECT_EQ(json_error(document), "node 0: names accessor 7 of 2");
  document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"] = json::object();
  EXPECT_NE(json_error(document), "");
}

TEST(ImportGltf, text_that_is_no_json_is_named_by_line_and_column) {
  const std::string good = square().dump(1);
  const auto error_with = [&](const std::string& what, const std::string& by) {
    std::string text = good;
    text.replace(text.find(what), what.size(), by);
    return import_error("a.gltf", text);
  };
  // Before, within and behind what is read apart from the rest.
  EXPECT_EQ(error_with("\"asset\"", "asset"),
            "line 16, column 2: is no JSON: a name in quotes is expected, not asset");
  EXPECT_EQ(error_with("60,", "60"), "line 33, column 4: is no JSON: a comma or } is expected, not \"uri\"");
  EXPECT_EQ(error_with("\"scene\"", "scene"),
            "line 67, column 2: is no JSON: a name in quotes is expected, not scene");
}

TEST(ImportGltf, a_required_extension_that_is_not_known_is_refused_by_name) {
  json document = square();
  document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  EXPECT_NE(json_error(document).find("KHR_draco_mesh_compression"), std::string::npos);
}

TEST(ImportGltf, nodes_in_a_cycle_with_two_parents_or_out_of_range_are_refused) {
  json document = square();
  document["nodes"] = json::parse(R"([{"mesh": 0}, {"children": [2]}, {"children": [1]}])");
  EXPECT_NE(json_error(document).find("cycle"), std::string::npos);
  document["nodes"] = json::parse(R"([{"mesh": 0, "children": [2]}, {"children": [2]}, {"mesh": 0}])");
  EXPECT_EQ(json_error(document), "node 2: has several parents");
  document["nodes"] = json::parse(R"([{"mesh": 0, "children": [0]}])");
  EXPECT_NE(json_error(document), "");
  document["nodes"] = json::parse(R"([{"mesh": 0, "children": [9]}])");
  EXPECT_EQ(json_error(document), "node 0: names node 9 of 1");
  document["nodes"] = json::parse(R"([{"mesh": 5}])");
  EXPECT_EQ(json_error(document), "node 0: names mesh 5 of 1");
}

TEST(ImportGltf, twenty_thousand_nested_nodes_are_walked) {
  json document = square();
  document["nodes"] = json::array();
  for (int i = 0; i < 20000; ++i)
    document["nodes"].push_back({{"children", {i + 1}}, {"translation", {1, 0, 0}}});
  document["nodes"].push_back({{"mesh", 0}});
  const Model model = import_json(document);
  EXPECT_EQ(model.instances[0].transform[3], glm::dvec3(20000, 0, 0));
}

TEST(ImportGltf, every_range_is_checked) {
  const auto refused = [](auto&& change) {
    json document = square();
    change(document);
    const std::string error = json_error(document);
    EXPECT_NE(error, "");
    return error.substr(std::min(error.size(), error.find("mesh 0")));
  };
  EXPECT_EQ(refused([](json& d) { d["accessors"][0]["count"] = 5; }).substr(0, 19), "mesh 0 primitive 0 ");
  refused([](json& d) { d["accessors"][0]["count"] = 1000000000000ull; });
  refused([](json& d) { d["accessors"][0]["count"] = 18446744073709551615ull; });
  refused([](json& d) { d["accessors"][0]["byteOffset"] = 18446744073709551615ull; });
  refused([](json& d) { d["accessors"][0]["byteOffset"] = 4; });
  refused([](json& d) { d["accessors"][0]["bufferView"] = 9; });
  refused([](json& d) { d["accessors"][0]["type"] = "MAT4"; });
  refused([](json& d) { d["accessors"][0]["type"] = "VEC2"; });
  refused([](json& d) { d["accessors"][1]["componentType"] = 5126; });
  refused([](json& d) { d["accessors"][1]["count"] = 7; });
  refused([](json& d) { d["bufferViews"][0]["byteLength"] = 61; });
  refused([](json& d) { d["bufferViews"][0]["byteOffset"] = 18446744073709551610ull; });
  refused([](json& d) { d["bufferViews"][0]["buffer"] = 1; });
  refused([](json& d) { d["bufferViews"][0]["byteStride"] = 8; });
  refused([](json& d) { d["meshes"][0]["primitives"][0]["material"] = 3; });
  refused([](json& d) { d["meshes"][0]["primitives"][0]["indices"] = 12; });
  refused([](json& d) { d["meshes"][0]["primitives"][0]["mode"] = 9; });
  refused([](json& d) { d["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 99; });
  refused([](json& d) { d["nodes"][0]["matrix"] = {1, 2, 3}; });
  refused([](json& d) { d["scene"] = 4; });
  EXPECT_EQ(refused([](json& d) {
              d["accessors"][1]["bufferView"] = 0, d["accessors"][1]["byteOffset"] = 12;
            }).substr(0, 26),
            "mesh 0 primitive 0: index ");
}

TEST(ImportGltf, a_buffer_that_is_missing_or_of_another_length_is_refused) {
  json document = square();
  document["buffers"][0]["uri"] = "missing.bin";
  EXPECT_NE(json_error(document).find("missing.bin"), std::string::npos);
  document["buffers"][0]["uri"] = ".";
  EXPECT_NE(json_error(document), "");
  document = square();
  document["buffers"][0]["byteLength"] = 1ull << 40;
  EXPECT_NE(json_error(document), "");
}

TEST(ImportGltf, a_binary_file_that_is_cut_or_lies_about_its_lengths_is_refused) {
  const std::string whole = glb(square(), square_bytes());
  for (size_t length = 0; length < whole.size(); ++length)
    ASSERT_NE(import_error("a.glb", whole.substr(0, length)), "") << length;
  EXPECT_NE(import_error("a.glb", std::string("glTF\x02\0\0\0\xff\xff\xff\x7f", 12)), "");
  for (const size_t at : {size_t{12}, whole.find("BIN") - 4}) {
    for (const uint32_t value : {0u, 0x7fffffffu, 0xffffffffu, 0xfffffffcu}) {
      std::string damaged = whole;
      std::memcpy(damaged.data() + at, &value, sizeof(value));
      EXPECT_NE(import_error("a.glb", damaged), "") << at << " " << value;
    }
  }
}

TEST(ImportGltf, another_version_is_refused) {
  json document = square();
  document["asset"]["version"] = "1.0";
  EXPECT_EQ(json_error(document), "is glTF of version 1.0; only 2 is known");
  document["asset"]["version"] = "2.1";
  EXPECT_EQ(json_error(document), "");
}

TEST(ImportGltf, deeply_nested_json_is_refused) {
  for (const char* opening : {"[", "{\"extras\":"}) {
    std::string text;
    for (int i = 0; i < 300000; ++i) text += opening;
    EXPECT_NE(import_error("deep.gltf", text).find("nested"), std::string::npos);
  }
}

TEST(ImportGltf, what_is_not_drawn_or_not_placed_is_said) {
  json document = square();
  document["meshes"].push_back(document["meshes"][0]);
  document["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 0}}};
  document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  document["textures"] = {{{"source", 0}}};
  document["images"] = {{{"uri", "missing.png"}}};
  const Model model = import_json(document);
  for (const char* warning : {"1 meshes are placed nowhere", "morph targets", "missing.png"}) {
    EXPECT_TRUE(warns(model, warning)) << warning;
  }
}

/// The square with an attribute behind it in its buffer: four elements of a type, as bytes.
Model square_with(const std::string& attribute, const json& accessor, const std::string& values,
                  const ImportOptions& options = {}) {
  json document = square();
  document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 60}, {"byteLength", values.size()}});
  document["accessors"].push_back(accessor);
  document["meshes"][0]["primitives"][0]["attributes"][attribute] = 2;
  // A file that streams read must not change: each has its own.
  static int files = 0;
  return import_text(std::to_string(files++) + ".glb", glb(document, square_bytes() + values), options);
}

Model colored_square(const json& accessor, const std::string& colors, const ImportOptions& options = {}) {
  return square_with("COLOR_0", accessor, colors, options);
}

template <typename Value>
std::string four(std::initializer_list<Value> element) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) {
    for (const Value value : element) append(bytes, value);
  }
  return bytes;
}

TEST(ImportGltf, vertex_colours_of_every_type_are_linear_light) {
  const auto accessor = [](int type, const char* kind) {
    return json{{"bufferView", 2},
                {"componentType", type},
                {"count", 4},
                {"type", kind},
                {"normalized", type != 5126}};
  };
  const VertexColor wanted{255, 188, 0, 255};  // one, a half, none
  for (const uint64_t stream_above : {uint64_t{1000}, uint64_t{0}}) {
    const ImportOptions options{.stream_above = stream_above};
    for (const Model& model :
         {colored_square(accessor(5126, "VEC3"), four<float>({1, 0.5f, 0}), options),
          colored_square(accessor(5126, "VEC4"), four<float>({1, 0.5f, 0, 0.25f}), options),
          colored_square(accessor(5121, "VEC4"), four<uint8_t>({255, 128, 0, 9}), options),
          colored_square(accessor(5123, "VEC3"), four<uint16_t>({65535, 32768, 0}), options)}) {
      EXPECT_EQ(model.meshes[0].stream != nullptr, stream_above == 0);
      EXPECT_TRUE(model.meshes[0].has_colors());
      read_mesh(model.meshes[0], [&](std::span<const CornerTriangle> batch) {
        for (const CornerTriangle& triangle : batch) {
          for (const VertexColor& color : triangle.colors) {
            for (size_t i = 0; i < 4; ++i) EXPECT_NEAR(color[i], wanted[i], 1);
          }
        }
      });
      EXPECT_TRUE(model.report.warnings.empty());
    }
  }
}

TEST(ImportGltf, normals_are_directions_of_every_type) {
  const VertexNormal wanted = to_vertex_normal({0.6, 0, -0.8});
  for (const uint64_t stream_above : {uint64_t{1000}, uint64_t{0}}) {
    const ImportOptions options{.stream_above = stream_above};
    const json floats = {{"bufferView", 2}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}};
    json shorts = floats;
    shorts["componentType"] = 5122;
    shorts["normalized"] = true;
    for (const Model& model : {square_with("NORMAL", floats, four<float>({0.6f, 0, -0.8f}), options),
                               square_with("NORMAL", shorts, four<int16_t>({19660, 0, -26214}), options)}) {
      EXPECT_TRUE(model.meshes[0].has_normals());
      read_mesh(model.meshes[0], [&](std::span<const CornerTriangle> batch) {
        for (const CornerTriangle& triangle : batch) {
          for (const VertexNormal& normal : triangle.normals) EXPECT_EQ(normal, wanted);
        }
      });
      EXPECT_TRUE(model.report.warnings.empty());
    }
  }
  const json few = {{"bufferView", 2}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}};
  const Model without = square_with("NORMAL", few, four<float>({0, 0, 1}));
  EXPECT_EQ(without.source_triangles(), 2u);
  EXPECT_FALSE(without.meshes[0].has_normals());
  EXPECT_TRUE(warns(without, "normals cannot be read"));
}

TEST(ImportGltf, vertex_colours_that_cannot_be_read_are_said_and_lose_no_triangle) {
  for (const json& accessor :
       {json{{"bufferView", 2}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}},
        json{{"bufferView", 2}, {"componentType", 5126}, {"count", 4}, {"type", "VEC2"}},
        json{{"bufferView", 9}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}}}) {
    const Model model = colored_square(accessor, four<float>({1, 0.5f, 0}));
    EXPECT_EQ(model.source_triangles(), 2u);
    EXPECT_FALSE(model.meshes[0].has_colors());
    EXPECT_TRUE(warns(model, "vertex colours cannot be read"));
  }
}

TEST(ImportGltf, triangles_and_transforms_that_are_not_finite_are_dropped_and_counted) {
  std::string bytes = square_bytes();
  const float bad = std::nanf("");
  std::memcpy(bytes.data() + 36, &bad, sizeof(bad));
  const Model model = import_text("a.glb", glb(square(), bytes));
  EXPECT_EQ(model.report.dropped_triangles, 1u);
  EXPECT_EQ(model.meshes[0].positions.size(), 3u);
  json document = square();
  document["nodes"] =
      json::parse(R"([{"scale": [1e200, 1, 1], "children": [1]}, {"scale": [1e200, 1, 1], "mesh": 0}])");
  EXPECT_EQ(json_error(document),
            "holds no triangles: 1 placements were dropped: their transforms are not finite");
}

TEST(ImportGltf, no_damage_makes_it_crash) { expect_robust("a.glb", glb(square(), square_bytes())); }

}  // namespace
}  // namespace triptych
