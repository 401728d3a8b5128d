// Lights of glTF (KHR_lights_punctual): where they are, where they shine, and how much.
#include "gltf_support.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace triptych {
namespace {

using nlohmann::json;
using test::import_text;
using test::square;
using test::square_bytes;
using test::warns;
using test::write_model;

/// The square, and a node with the light, turned by a quarter about x and moved, below one that is moved.
json lit(const json& light) {
  json document = square();
  document["extensions"]["KHR_lights_punctual"]["lights"] = {light};
  json& nodes = document["nodes"];
  const size_t first = nodes.size();
  nodes.push_back({{"translation", {1, 2, 3}}, {"children", {first + 1}}});
  nodes.push_back({{"translation", {0, 1, 0}},
                   {"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}},
                   {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  if (document.contains("scenes")) document["scenes"][0]["nodes"].push_back(first);
  return document;
}

Model import_lit(const json& light) {
  write_model("square.bin", square_bytes());
  return import_text("a.gltf", lit(light).dump());
}

TEST(ImportGltfLights, are_where_their_nodes_are_and_as_bright_as_colour_and_intensity_say) {
  const Model model =
      import_lit({{"type", "point"}, {"color", {1, 0.5, 0.25}}, {"intensity", 40}, {"range", 7}});
  EXPECT_TRUE(model.report.warnings.empty());
  ASSERT_EQ(model.lights.size(), 1u);
  const ModelLight& light = model.lights[0];
  EXPECT_EQ(light.kind, ModelLight::Kind::point);
  EXPECT_EQ(light.position, glm::dvec3(1, 3, 3));
  EXPECT_EQ(light.intensity, glm::dvec3(40, 20, 10));
  EXPECT_EQ(light.range, 7);
}

TEST(ImportGltfLights, shine_along_the_negative_z_of_their_nodes) {
  const Model model =
      import_lit({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.5}}}});
  ASSERT_EQ(model.lights.size(), 1u);
  EXPECT_EQ(model.lights[0].kind, ModelLight::Kind::spot);
  EXPECT_LT(glm::distance(model.lights[0].direction, glm::dvec3(0, -1, 0)), 1e-9);
  EXPECT_EQ(model.lights[0].intensity, glm::dvec3(1));
  EXPECT_DOUBLE_EQ(model.lights[0].inner_cosine, std::cos(0.2));
  EXPECT_DOUBLE_EQ(model.lights[0].outer_cosine, std::cos(0.5));
}

TEST(ImportGltfLights, that_cannot_be_are_left_out_with_a_warning) {
  for (const json& light : {json{{"type", "laser"}}, json{{"type", "point"}, {"intensity", -1}}, json(3)}) {
    const Model model = import_lit(light);
    EXPECT_TRUE(model.lights.empty());
    EXPECT_TRUE(warns(model, "give no light")) << light;
  }
}

TEST(ImportGltfLights, a_strength_beyond_one_is_given_though_not_shown) {
  write_model("square.bin", square_bytes());
  json document = square();
  document["materials"][0]["emissiveFactor"] = {1, 0.5, 0};
  document["materials"][0]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 3;
  const Model model = import_text("a.gltf", document.dump());
  EXPECT_EQ(model.materials.back().emission, glm::vec3(1, 1, 0));
  EXPECT_EQ(model.materials.back().emitted, glm::vec3(3, 1.5f, 0));
}

}  // namespace
}  // namespace triptych
