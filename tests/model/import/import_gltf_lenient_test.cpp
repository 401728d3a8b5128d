// glTF as programs write it: what is damaged or unknown costs only itself, and what is compressed is
// unpacked.
#include "gltf_support.hpp"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <glm/vec4.hpp>
#include <meshoptimizer.h>

namespace triptych {
namespace {

using nlohmann::json;
using test::import_json;
using test::json_error;
using test::square;
using test::square_bytes;
using test::warns;
using test::write_model;

TEST(ImportGltfLenient, what_is_never_drawn_may_be_of_any_form) {
  json document = square();
  document["skins"] = json::parse(R"([{"joints": "none"}, 7])");
  document["animations"] = json::parse(R"([{"channels": [{"target": {}}]}])");
  document["cameras"] = 1;
  document["textures"] = json::parse(R"([{"source": -4}])");
  document["samplers"] = {{"a", 1}};
  document["extensions"] = {{"KHR_lights_punctual", json::array()}};
  document["extensionsRequired"] = {"VENDOR_something"};
  document["materials"][0]["normalTexture"] = json::object();
  document["nodes"][0]["extras"] = nullptr;
  document["nodes"][0]["camera"] = "x";
  document["accessors"][0]["count"] = 4.0;
  const Model model = import_json(document);
  EXPECT_EQ(model.source_triangles(), 2u);
  EXPECT_TRUE(
      warns(model, "extension is required that is not known, what it adds is not drawn: VENDOR_something"));
  EXPECT_TRUE(warns(model, "members \"joints\" are of a wrong type"));
}

TEST(ImportGltfLenient, a_primitive_that_cannot_be_read_costs_only_itself) {
  json document = square();
  document["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 9}}}});
  document["buffers"].push_back({{"byteLength", 9}, {"uri", "gone.bin"}});
  const Model model = import_json(document);
  EXPECT_EQ(model.source_triangles(), 2u);
  EXPECT_TRUE(
      warns(model,
            "1 primitives cannot be read and were skipped, the first: mesh 0 primitive 1: names accessor 9"));
}

TEST(ImportGltfLenient, matrices_are_affine_but_for_rounding_and_rotations_may_be_zero) {
  json document = square();
  document["nodes"][0]["matrix"] = {1, 0, 0, 1e-9, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 0.9999999};
  const Model rounded = import_json(document);
  EXPECT_EQ(rounded.instances[0].transform[3], glm::dvec3(5, 6, 7));
  EXPECT_FALSE(warns(rounded, "not affine"));
  document["nodes"][0]["matrix"][15] = 4;
  EXPECT_TRUE(warns(import_json(document), "1 nodes have a matrix that is not affine"));
  document = square();
  document["nodes"][0]["rotation"] = {0, 0, 0, 0};
  EXPECT_EQ(import_json(document).instances[0].transform, Affine(1));
}

TEST(ImportGltfLenient, hidden_nodes_hide_what_is_below_them) {
  json document = square();
  document["nodes"] = json::parse(
      R"([{"mesh": 0, "children": [1]}, {"extensions": {"KHR_node_visibility": {"visible": false}}, "children": [2]}, {"mesh": 0}])");
  const Model model = import_json(document);
  EXPECT_EQ(model.instances.size(), 1u);
  EXPECT_TRUE(warns(model, "1 nodes that the file hides"));
}

TEST(ImportGltfLenient, the_diffuse_colour_of_specular_glossiness_is_drawn) {
  json document = square();
  document["materials"][0] = json::parse(
      R"({"extensions": {"KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [1, 0.5, 0.25, 1]}}})");
  const Model model = import_json(document);
  EXPECT_EQ(model.materials[model.meshes[0].triangles[0].material].base_color, glm::vec4(1, 0.5, 0.25, 1));
}

TEST(ImportGltfLenient, uris_have_backslashes_any_media_type_or_none) {
  std::filesystem::create_directories(write_model("square.bin", square_bytes()).parent_path() / "sub folder");
  write_model("sub folder/b.bin", square_bytes());
  json document = square();
  document["buffers"][0]["uri"] = "sub%20folder\\b.bin";
  EXPECT_EQ(import_json(document).source_triangles(), 2u);
  const std::string data = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAACAPwAAgD8AAAAAAAABAAIAAgABAAMA";
  for (const char* head :
       {"data:;base64,", "data:model/vnd.x;charset=utf-8;base64,", "DATA:application/gltf-buffer;base64,"}) {
    document["buffers"][0]["uri"] = head + data;
    EXPECT_EQ(import_json(document).source_triangles(), 2u) << head;
  }
  document["buffers"][0]["uri"] = "data:nothing";
  const std::string error = json_error(document);
  EXPECT_NE(error.find("no comma"), std::string::npos) << error;
}

TEST(ImportGltfLenient, chunks_and_bytes_behind_those_of_a_binary_file_are_passed_over) {
  std::string file = test::glb(square(), square_bytes());
  EXPECT_TRUE(
      warns(test::import_text("a.glb", file + "1234567"), "7 bytes after the last chunk were skipped"));
  const uint32_t longer = 0x7fffffff;
  std::memcpy(file.data() + 8, &longer, sizeof(longer));
  EXPECT_TRUE(warns(test::import_text("a.glb", file), "the header says 2147483647 bytes"));
}

void bind_to_joints(json& document, const std::string& extra_nodes) {
  std::string bytes = square_bytes();
  for (int i = 0; i < 4; ++i) {  // corners 0 and 1 to the first joint, 2 and 3 to the second
    for (const int joint : {i / 2, 0, 0, 0}) bytes += static_cast<char>(joint);
  }
  for (int i = 0; i < 4; ++i) {
    for (const float weight : {2.f, 0.f, 0.f, 0.f}) test::append(bytes, weight);
  }
  write_model("bound.bin", bytes);
  document["buffers"][0] = {{"byteLength", bytes.size()}, {"uri", "bound.bin"}};
  document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 60}, {"byteLength", 16}});
  document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 76}, {"byteLength", 64}});
  document["accessors"].push_back(
      {{"bufferView", 2}, {"componentType", 5121}, {"count", 4}, {"type", "VEC4"}});
  document["accessors"].push_back(
      {{"bufferView", 3}, {"componentType", 5126}, {"count", 4}, {"type", "VEC4"}});
  document["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] = 2;
  document["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = 3;
  document["nodes"] =
      json::parse(R"([{"mesh": 0, "skin": 0, "translation": [100, 0, 0]},)" + extra_nodes + "]");
  document["skins"] = json::parse(R"([{"joints": [1, 2]}])");
  document["scenes"][0]["nodes"] = {0, 1, 2};
}

TEST(ImportGltfLenient, only_its_joints_move_a_skinned_mesh) {
  json document = square();
  bind_to_joints(document, R"({"translation": [0, 7, 0]}, {"translation": [0, 7, 0]})");
  const Model alike = import_json(document);
  ASSERT_EQ(alike.instances.size(), 1u);
  EXPECT_EQ(alike.instances[0].transform[3], glm::dvec3(0, 7, 0));
  document = square();
  bind_to_joints(document, R"({"translation": [0, 7, 0]}, {"translation": [0, 9, 0]})");
  const Model bent = import_json(document);
  EXPECT_EQ(bent.instances[0].transform, Affine(1));
  EXPECT_EQ(bent.meshes[0].positions,
            (std::vector<glm::dvec3>{{0, 7, 0}, {1, 7, 0}, {0, 10, 0}, {1, 10, 0}}));
}

TEST(ImportGltfLenient, views_that_meshoptimizer_compressed_are_unpacked) {
  const std::string bytes = square_bytes();
  std::vector<unsigned char> vertices(meshopt_encodeVertexBufferBound(4, 12));
  vertices.resize(meshopt_encodeVertexBuffer(vertices.data(), vertices.size(), bytes.data(), 4, 12));
  const std::array<uint32_t, 6> numbers = {0, 1, 2, 2, 1, 3};
  std::vector<unsigned char> indices(meshopt_encodeIndexBufferBound(6, 4));
  indices.resize(meshopt_encodeIndexBuffer(indices.data(), indices.size(), numbers.data(), 6));
  std::string packed(vertices.begin(), vertices.end());
  packed.append(indices.begin(), indices.end());
  write_model("packed.bin", packed);
  json document = square();
  document["buffers"] = {
      {{"byteLength", packed.size()}, {"uri", "packed.bin"}},
      {{"byteLength", 60}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
  for (auto& view : document["bufferViews"]) view["buffer"] = 1;
  document["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                                         {"byteLength", vertices.size()},
                                                                         {"byteStride", 12},
                                                                         {"count", 4},
                                                                         {"mode", "ATTRIBUTES"}};
  document["bufferViews"][1]["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                                         {"byteOffset", vertices.size()},
                                                                         {"byteLength", indices.size()},
                                                                         {"byteStride", 2},
                                                                         {"count", 6},
                                                                         {"mode", "TRIANGLES"}};
  document["extensionsRequired"] = {"EXT_meshopt_compression"};
  const Model model = import_json(document);
  EXPECT_EQ(model.source_triangles(), 2u);
  EXPECT_EQ(model.meshes[0].positions.size(), 4u);
  document["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["count"] = 1u << 30;
  EXPECT_NE(json_error(document).find("EXT_meshopt_compression"), std::string::npos);
}

TEST(ImportGltfLenient, primitives_that_draco_compressed_are_unpacked) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(1);
  const int attribute = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const std::array<float, 9> corners = {0, 0, 0, 1, 0, 0, 0, 2, 3};
  builder.SetAttributeValuesForFace(attribute, draco::FaceIndex(0), &corners[0], &corners[3], &corners[6]);
  const auto mesh = builder.Finalize();
  draco::EncoderBuffer buffer;
  draco::Encoder encoder;
  ASSERT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  write_model("draco.bin", {buffer.data(), buffer.size()});
  json document = square();
  document["buffers"] = {{{"byteLength", buffer.size()}, {"uri", "draco.bin"}}};
  document["bufferViews"] = {{{"buffer", 0}, {"byteLength", buffer.size()}}};
  document["accessors"] = json::parse(R"([{"componentType": 5126, "count": 3, "type": "VEC3"}])");
  auto& primitive = document["meshes"][0]["primitives"][0];
  primitive.erase("indices");
  primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0},
                                                           {"attributes", {{"POSITION", 0}}}};
  document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  const Model model = import_json(document);
  ASSERT_EQ(model.source_triangles(), 1u);
  double highest = 0;
  for (const glm::dvec3& position : model.meshes[0].positions) highest = std::max(highest, position.z);
  EXPECT_NEAR(highest, 3, 1e-6);
  write_model("draco.bin", std::string(buffer.size(), 'x'));
  EXPECT_NE(json_error(document).find("KHR_draco_mesh_compression: its data cannot be unpacked"),
            std::string::npos);
  test::expect_robust("a.glb", test::glb(document, {buffer.data(), buffer.size()}));
}

}  // namespace
}  // namespace triptych
