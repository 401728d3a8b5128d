#include "preprocess/flat_colors.hpp"

#include "preprocess/build.hpp"
#include "scene/effects.hpp"
#include "scene/pack.hpp"
#include "tests/support/awkward_meshes.hpp"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

namespace triptych {
namespace {

constexpr VertexColor red{255, 0, 0, 255}, blue{0, 0, 255, 255};

TEST(FlatColors, are_those_that_all_corners_of_each_triangle_share) {
  const VertexTint white;
  FlatColorSearch search(white);
  search.add({red, red, red}, 0);
  search.add({blue, blue, blue}, 0);
  search.add({red, red, red}, 0);
  ASSERT_TRUE(search.colors());
  EXPECT_EQ(*search.colors(), (std::set<DisplayColor>{red, blue}));
  search.add({red, red, blue}, 0);
  EXPECT_FALSE(search.colors());
}

TEST(FlatColors, more_of_them_than_the_limit_are_a_gradient) {
  const VertexTint white;
  FlatColorSearch search(white);
  for (size_t i = 0; i <= max_flat_colors; ++i) {
    EXPECT_TRUE(search.colors()) << i;
    const VertexColor color{static_cast<uint8_t>(i), 0, 0, 255};
    search.add({color, color, color}, 0);
  }
  EXPECT_FALSE(search.colors());
}

TEST(FlatColors, are_multiplied_by_the_material_and_keep_its_alpha) {
  const std::vector<Material> materials = {{}, {{1, 1, 1, 0.5f}}};
  const VertexTint tint(materials);
  EXPECT_EQ(tint.flat({red, red, red}, 1), (DisplayColor{255, 0, 0, 128}));
  EXPECT_EQ(tint.flat({}, 1), (DisplayColor{255, 255, 255, 128})) << "vertices without colours";
  EXPECT_EQ(tint.flat({red, {}, red}, 1), std::nullopt);
}

/// Two spheres in one mesh: by vertex colours, or by materials.
Model spheres(bool by_vertices) {
  Model model = awkward::model_of({awkward::sphere(12, 0.5), awkward::sphere(10, 0.5)});
  model.materials = {{}, {{0, 0, 1, 1}}, {{1, 0, 0, 1}}};
  Mesh joined{"joined", {}, {}};
  for (size_t i = 0; i < 2; ++i) {
    const auto first = static_cast<uint32_t>(joined.positions.size());
    for (const glm::dvec3& position : model.meshes[i].positions)
      joined.positions.push_back(position + glm::dvec3(2.0 * static_cast<double>(i), 0, 0));
    for (Triangle triangle : model.meshes[i].triangles) {
      for (uint32_t& vertex : triangle.vertices) vertex += first;
      joined.triangles.push_back({triangle.vertices, by_vertices ? 0 : static_cast<uint32_t>(i) + 1});
    }
    if (by_vertices) joined.colors.resize(joined.positions.size(), i == 0 ? blue : red);
  }
  if (by_vertices) model.materials = {{}};
  model.meshes = {std::move(joined)};
  model.instances = {{0, Affine(1)}};
  return model;
}

TEST(FlatColors, make_the_pack_that_materials_make) {
  std::vector<Pack> packs;
  std::vector<std::filesystem::path> files;
  for (const bool by_vertices : {false, true}) {
    files.push_back(std::filesystem::path(testing::TempDir()) /
                    ("flat_colors_" + std::to_string(getpid()) + std::to_string(by_vertices) + ".tpk"));
    build_pack(spheres(by_vertices), {}, files.back());
    packs.emplace_back(files.back());
  }
  for (const Pack& pack : packs)
    EXPECT_EQ(std::ranges::count(pack.skeleton().effects, effect_name_in_pack(Effect::vertex_colors)), 0);
  EXPECT_EQ(packs[0].skeleton().palette, packs[1].skeleton().palette);
  EXPECT_EQ(packs[0].content_hash(), packs[1].content_hash());
  for (const auto& file : files) std::filesystem::remove(file);
}

}  // namespace
}  // namespace triptych
