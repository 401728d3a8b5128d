// Which surfaces lie on which in one plane.
#include "scene/layers.hpp"

#include "preprocess/layers/layer_facets.hpp"
#include "tests/preprocess/parts_scene.hpp"

#include <gtest/gtest.h>
#include <map>

namespace triptych {
namespace {

using test::step;

/// A rectangle in the plane z, seen from above.
Mesh sheet(const glm::dvec2& lo, const glm::dvec2& hi, double z, uint32_t material) {
  return {.name = "sheet",
          .positions = {{lo.x, lo.y, z}, {hi.x, lo.y, z}, {hi.x, hi.y, z}, {lo.x, hi.y, z}},
          .triangles = {{{0, 1, 2}, material}, {{0, 2, 3}, material}}};
}

Mesh turned_over(Mesh mesh) {
  for (Triangle& triangle : mesh.triangles) std::swap(triangle.vertices[0], triangle.vertices[1]);
  return mesh;
}

Mesh both(Mesh mesh, const Mesh& other) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (Triangle triangle : other.triangles) {
    for (uint32_t& corner : triangle.vertices) corner += first;
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

struct LayerScene : test::PartsScene {
  LayerReport make() { return make_layers(parts, file, 1 << 20, PlacedCache(nullptr, parts, file)); }
  /// Triangles of a part by how many layers lie on them; not the uppermost.
  std::map<uint32_t, int> layers(uint32_t part) const {
    std::map<uint32_t, int> counts;
    for (const LayeredTriangle& triangle : parts.parts[part].layers) {
      if (triangle.layer > 1) ++counts[triangle.layer - 1];
    }
    return counts;
  }
};

using Counts = std::map<uint32_t, int>;

TEST(Layers, a_carpet_flush_with_a_slab_lies_on_it_and_paint_on_both) {
  LayerScene scene;
  scene.add(awkward::box({-8, -8, -1}, {8, 8, 0}, 0));
  scene.add(awkward::box({-4, -4, -0.125}, {4, 4, 0}, 1));
  scene.add(sheet({-6, -1}, {6, 0.5}, 0, 2));
  const LayerReport report = scene.make();
  EXPECT_EQ(scene.layers(0), (Counts{{2, 2}})) << "its upper face alone";
  EXPECT_EQ(scene.layers(1), (Counts{{1, 2}}));
  EXPECT_EQ(scene.layers(2), Counts());
  EXPECT_EQ(report.facets, 2u);
  EXPECT_EQ(report.triangles, 4u);
  EXPECT_EQ(report.most, 3u);
}

TEST(Layers, side_by_side_one_behind_the_other_back_to_back_and_of_one_colour_there_are_none) {
  LayerScene scene;
  scene.add(awkward::box({0, 0, 0}, {1, 1, 1}, 0));
  scene.add(awkward::box({1, 0, 0}, {2, 1, 1}, 1));                 // side by side, and front to front
  scene.add(awkward::box({0, 0, 1}, {1, 1, 2}, 1));                 // on top
  scene.add(awkward::box({0.25, 0.25, 0.25}, {0.75, 0.75, 1}, 0));  // of one colour
  scene.add(sheet({1, 0}, {2, 1}, 1 + 40 * step, 2));               // just above
  EXPECT_EQ(scene.make().facets, 0u);
}

TEST(Layers, sheets_that_show_either_side_lie_on_each_other_whichever_way_they_face) {
  LayerScene scene;
  scene.add(sheet({0, 0}, {4, 4}, 0, 0));
  scene.add(turned_over(sheet({1, 1}, {2, 2}, 0, 1)));
  scene.make();
  EXPECT_EQ(scene.layers(0), (Counts{{1, 2}}));
  EXPECT_EQ(scene.layers(1), Counts());
}

TEST(Layers, files_of_single_precision_are_flat_within_a_few_steps) {
  LayerScene scene;
  scene.add(sheet({0, 0}, {4, 4}, 0, 0));
  scene.add(sheet({1, 1}, {2, 2}, -10 * step, 1));
  scene.add(sheet({2.5, 1}, {3, 2}, -30 * step, 1));
  scene.make();
  EXPECT_EQ(scene.layers(0), (Counts{{1, 2}}));
  EXPECT_EQ(scene.layers(2), Counts()) << "that one lies behind";
}

TEST(Layers, of_what_is_as_large_the_later_one_lies_above) {
  LayerScene scene;
  scene.add(sheet({0, 0}, {2, 2}, 0, 0));
  scene.add(sheet({1, 1}, {3, 3}, 0, 1));
  scene.make();
  EXPECT_EQ(scene.layers(0), (Counts{{1, 2}}));
  EXPECT_EQ(scene.layers(1), Counts());
}

TEST(Layers, a_mesh_that_was_divided_still_lies_below_what_is_smaller_than_all_of_it) {
  LayerScene scene;
  // Two parts of one instance; the carpet is larger than either.
  scene.add(sheet({0, 0}, {2, 8}, 0, 0));
  scene.add(sheet({2, 0}, {8, 2}, 0, 0));
  scene.hierarchy().placed[1].instance = scene.hierarchy().placed[0].instance;
  scene.add(sheet({0, 0}, {5, 5}, 0, 1));
  scene.make();
  EXPECT_EQ(scene.layers(0), (Counts{{1, 2}}));
  EXPECT_EQ(scene.layers(1), (Counts{{1, 2}}));
  EXPECT_EQ(scene.layers(2), Counts());
}

TEST(Layers, within_one_mesh_the_smaller_face_lies_on_the_larger_one) {
  LayerScene scene;
  scene.add(both(sheet({1, 1}, {2, 2}, 0, 1), sheet({0, 0}, {4, 4}, 0, 0)));
  scene.make();
  std::vector<uint32_t> layers;
  for (const LayeredTriangle& triangle : scene.parts.parts[0].layers) layers.push_back(triangle.layer);
  EXPECT_EQ(layers, (std::vector<uint32_t>{1, 1, 2, 2}));
}

TEST(Layers, a_placement_that_lies_on_something_is_enough_for_all_and_turned_ones_count) {
  LayerScene scene;
  const uint32_t wall = scene.add_part(sheet({-8, -8}, {8, 8}, 0, 0));
  scene.place(wall, {0, 0, 5});
  scene.place(wall);
  const uint32_t panel = scene.add_part(sheet({0, 0}, {1, 1}, 0, 1));
  scene.place(panel);
  Affine& turned = scene.hierarchy().transforms.back();
  turned = Affine({0.6, 0.8, 0}, {0.8, -0.6, 0}, {0, 0, 1}, {1, 2, 5});  // mirrored
  scene.hierarchy().boxes.back() = {glm::ivec3(glm::dvec3(0, 1, 5) / step),
                                    glm::ivec3(glm::dvec3(3, 4, 5) / step)};
  scene.make();
  EXPECT_EQ(scene.layers(wall), (Counts{{1, 2}}));
  EXPECT_EQ(scene.layers(panel), Counts());
}

TEST(Layers, more_than_can_be_stored_are_as_many_as_can) {
  LayerScene scene;
  for (uint32_t i = 0; i < 20; ++i) scene.add(sheet({0, 0}, {20.0 - i, 20.0 - i}, 0, i % 3));
  const LayerReport report = scene.make();
  // Those of one colour do not lie on each other.
  EXPECT_EQ(report.most, max_layer);
  EXPECT_EQ(scene.layers(19), Counts());
  EXPECT_EQ(scene.layers(18), (Counts{{1, 2}}));
  EXPECT_EQ(scene.layers(0), (Counts{{max_layer - 1, 2}}));
}

}  // namespace
}  // namespace triptych
