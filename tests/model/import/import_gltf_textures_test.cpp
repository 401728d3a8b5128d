// Textures of glTF: where images are, what becomes of those that are not there, and what coordinates become.
#include "gltf_support.hpp"
#include "model/read_mesh.hpp"

#include <cmath>

namespace triptych {
namespace {

using nlohmann::json;
using test::append;
using test::import_json;
using test::import_text;
using test::square;
using test::square_bytes;
using test::warns;
using test::write_model;

/// The square, whose corners have these places on a texture.
json textured(const std::vector<std::array<float, 2>>& places, std::string& bytes) {
  bytes = square_bytes();
  for (const auto& [u, v] : places) {
    append(bytes, u);
    append(bytes, v);
  }
  json document = square();
  document["buffers"][0]["byteLength"] = bytes.size();
  document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 60}, {"byteLength", bytes.size() - 60}});
  document["accessors"].push_back(
      {{"bufferView", 2}, {"componentType", 5126}, {"count", places.size()}, {"type", "VEC2"}});
  document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 2;
  document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  document["textures"] = {{{"source", 0}}};
  document["images"] = {{{"uri", "data:image/png;base64,AAEC"}}};
  return document;
}

const std::vector<std::array<float, 2>> corners = {{0, 0}, {1, 0}, {0, 1}, {2.5f, -1}};

Model import_textured(json document, const std::string& bytes) {
  write_model("square.bin", bytes);
  return import_text("a.gltf", document.dump());
}

TEST(ImportGltfTextures, come_with_their_coordinates_and_images_of_data_uris) {
  std::string bytes;
  const json document = textured(corners, bytes);
  const Model model = import_textured(document, bytes);
  EXPECT_TRUE(model.report.warnings.empty());
  ASSERT_EQ(model.images.size(), 1u);
  EXPECT_EQ(model.images[0].read(), (std::vector<std::byte>{std::byte{0}, std::byte{1}, std::byte{2}}));
  const Material& material = model.materials.back();
  EXPECT_EQ(material.texture, 0u);
  EXPECT_EQ(material.sampler, TextureSampler());
  ASSERT_EQ(model.meshes[0].coordinates.size(), 4u);
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(model.meshes[0].coordinates[i],
              texture_coordinates(static_cast<double>(corners[i][0]), static_cast<double>(corners[i][1])))
        << i;
  }
}

TEST(ImportGltfTextures, images_are_found_in_buffers_and_beside_the_file) {
  std::string bytes;
  json document = textured(corners, bytes);
  document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 4}, {"byteLength", 3}});
  document["images"][0] = {{"bufferView", 3}, {"mimeType", "image/png"}};
  Model model = import_textured(document, bytes);
  ASSERT_EQ(model.images.size(), 1u);
  EXPECT_EQ(model.images[0].read().size(), 3u);
  document["images"][0] = {{"uri", "oak%20wood.png"}};
  write_model("oak wood.png", "12345");
  model = import_textured(document, bytes);
  ASSERT_EQ(model.images.size(), 1u);
  EXPECT_EQ(model.images[0].read().size(), 5u);
  EXPECT_EQ(model.files.back().filename(), "oak wood.png") << "it is a file of the model";
}

TEST(ImportGltfTextures, one_that_is_missing_is_said_with_its_name_and_the_mesh_is_drawn_without) {
  std::string bytes;
  json document = textured(corners, bytes);
  document["images"][0] = {{"uri", "gone.png"}};
  Model model = import_textured(document, bytes);
  EXPECT_EQ(model.materials.back().texture, no_id);
  EXPECT_TRUE(model.meshes[0].coordinates.empty());
  EXPECT_TRUE(warns(model, "images cannot be read")) << model.report.warnings.at(0);
  EXPECT_NE(model.report.warnings.at(0).find("gone.png"), std::string::npos);
  document["textures"] = json::array();
  model = import_textured(document, bytes);
  EXPECT_TRUE(warns(model, "materials name a texture that is not there"));
}

TEST(ImportGltfTextures, coordinates_that_cannot_be_read_are_said_and_the_primitive_is_drawn_without) {
  std::string bytes;
  json document = textured(corners, bytes);
  document["accessors"][2]["count"] = 3;
  Model model = import_textured(document, bytes);
  EXPECT_TRUE(model.meshes[0].coordinates.empty());
  EXPECT_TRUE(warns(model, "primitives whose texture coordinates cannot be read"));
  document["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0");
  model = import_textured(document, bytes);
  EXPECT_EQ(model.meshes[0].triangles.size(), 2u);
  EXPECT_TRUE(warns(model, "primitives whose texture coordinates cannot be read"));
}

TEST(ImportGltfTextures, samplers_say_how_they_end_and_whether_texels_are_mixed) {
  std::string bytes;
  json document = textured(corners, bytes);
  document["textures"][0]["sampler"] = 0;
  document["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
  const Model model = import_textured(document, bytes);
  EXPECT_EQ(model.materials.back().sampler,
            (TextureSampler{TextureWrap::clamp, TextureWrap::mirrored_repeat, true}));
}

TEST(ImportGltfTextures, transforms_scale_turn_and_move_their_coordinates) {
  std::string bytes;
  json document = textured({{1, 0}, {0, 1}, {0, 0}, {1, 1}}, bytes);
  json& use = document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  use["extensions"]["KHR_texture_transform"] = {
      {"offset", {0.25, 0.5}}, {"scale", {2, 3}}, {"rotation", std::acos(-1.0) / 2}};
  document["extensionsRequired"] = {"KHR_texture_transform"};
  const Model model = import_textured(document, bytes);
  EXPECT_TRUE(model.report.warnings.empty());
  const auto& found = model.meshes[0].coordinates;
  // By a quarter, counter-clockwise in the picture: what went to the right goes up.
  EXPECT_EQ(found[0], texture_coordinates(0.25, 0.5 - 2));
  EXPECT_EQ(found[1], texture_coordinates(0.25 + 3, 0.5));
  EXPECT_EQ(found[2], texture_coordinates(0.25, 0.5));
}

TEST(ImportGltfTextures, masks_cut_out_and_blends_let_through_as_the_texture_says) {
  std::string bytes;
  json document = textured(corners, bytes);
  document["materials"][0]["alphaMode"] = "MASK";
  document["materials"][0]["alphaCutoff"] = 0.3;
  Material material = import_textured(document, bytes).materials.back();
  EXPECT_FLOAT_EQ(material.cutoff, 0.4f) << "of the texture's own alpha, which the factor multiplies by 0.75";
  EXPECT_EQ(material.base_color.a, 1);
  EXPECT_FALSE(material.blends);
  document["materials"][0]["alphaMode"] = "BLEND";
  material = import_textured(document, bytes).materials.back();
  EXPECT_EQ(material.cutoff, 0);
  EXPECT_TRUE(material.blends);
  EXPECT_FLOAT_EQ(material.base_color.a, 0.75f);
}

TEST(ImportGltfTextures, emissive_factors_and_textures_come_along) {
  std::string bytes;
  json document = textured(corners, bytes);
  document["materials"][0]["emissiveFactor"] = {0.5, 0.25, 1};
  document["materials"][0]["emissiveTexture"] = {{"index", 0}};
  Material material = import_textured(document, bytes).materials.back();
  EXPECT_EQ(material.emission, glm::vec3(0.5, 0.25, 1));
  EXPECT_EQ(material.emission_texture, 0u);
  document["materials"][0]["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", 3}};
  material = import_textured(document, bytes).materials.back();
  EXPECT_EQ(material.emission, glm::vec3(1, 0.75, 1)) << "no more than white";
  document["materials"][0]["emissiveTexture"]["texCoord"] = 1;
  const Model model = import_textured(document, bytes);
  EXPECT_EQ(model.materials.back().emission_texture, no_id);
  EXPECT_TRUE(warns(model, "emissive textures with other coordinates"));
}

TEST(ImportGltfTextures, streams_have_the_same_coordinates_as_meshes_in_memory) {
  std::string bytes;
  const json document = textured(corners, bytes);
  write_model("square.bin", bytes);
  const std::filesystem::path file = write_model("a.gltf", document.dump());
  const auto corners_of = [](const Model& model) {
    std::vector<CornerTriangle> all;
    read_mesh(model.meshes[0], [&](std::span<const CornerTriangle> batch) {
      all.insert(all.end(), batch.begin(), batch.end());
    });
    return all;
  };
  const Model in_file = import_model({file}, test::streamed), in_memory = import_model({file});
  ASSERT_TRUE(in_file.meshes[0].stream);
  EXPECT_TRUE(in_file.meshes[0].has_coordinates());
  EXPECT_EQ(corners_of(in_file), corners_of(in_memory));
}

}  // namespace
}  // namespace triptych
