// What stands at the rim of a model: it keeps its cover, and the model its size.
#include "preprocess/build.hpp"
#include "scene/finest_boxes.hpp"
#include "scene/pack.hpp"
#include "tests/support/awkward_meshes.hpp"
#include "tests/support/drawable_triangles.hpp"

#include <filesystem>
#include <glm/glm.hpp>
#include <gtest/gtest.h>

namespace triptych {
namespace {

/// A layer of 20 x 20 balls, of one mesh or each of its own: all of them are at the rim.
Model balls(bool shared) {
  Model model = awkward::model_of({awkward::sphere(8, 0.25)});
  model.instances.clear();
  for (int i = 0; i < 400; ++i) {
    const Affine place = awkward::translation({i % 20, i / 20 + 0.25 * (i % 3), 0});
    if (shared) {
      model.instances.push_back({0, place});
      continue;
    }
    model.instances.push_back({static_cast<uint32_t>(model.meshes.size()), Affine(1)});
    Mesh mesh = model.meshes[0];
    for (glm::dvec3& position : mesh.positions) position = place * glm::dvec4(position, 1);
    model.meshes.push_back(std::move(mesh));
  }
  return model;
}

double area(const Pack& pack, DrawableId id) {
  double sum = 0;
  for (const judge::Corners& t : judge::triangles_of(pack, id))
    sum += glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) / 2;
  return sum;
}

TEST(Rim, what_stands_there_keeps_its_cover_and_the_model_its_size) {
  for (const bool shared : {false, true}) {
    const auto file = std::filesystem::path(testing::TempDir()) / (shared ? "rim_shared.tpk" : "rim.tpk");
    BuildOptions options;
    options.leaf_triangles = 2000;
    build_pack(balls(shared), options, file);
    const Pack pack(file);
    const Skeleton& skeleton = pack.skeleton();
    const Box box = model_box(skeleton);
    EXPECT_LT(glm::distance(box.lo, {-0.25, -0.25, -0.25}), 1e-4);
    EXPECT_LT(glm::distance(box.hi, {19.25, 19.75, 0.25}), 1e-4);
    const Box root = skeleton.lattice().box(skeleton.scene_nodes[0].box);
    EXPECT_TRUE(root.contains(box));
    EXPECT_FALSE(box.contains(root)) << "nothing was enlarged";
    size_t looked_at = 0;
    for (const SceneNode& node : skeleton.scene_nodes) {
      if (node.child_count > 0) continue;
      const double whole = area(pack, node.first_drawable);
      for (uint32_t i = 1; i < node.drawable_count; ++i) {
        const Drawable& drawable = skeleton.drawables[node.first_drawable + i];
        const double kept = area(pack, node.first_drawable + i) / whole;
        EXPECT_GT(kept, 0.9) << drawable.error;
        EXPECT_LT(kept, 1.1) << drawable.error;
        ++looked_at;
      }
    }
    EXPECT_GT(looked_at, 10u);
    std::filesystem::remove(file);
  }
}

}  // namespace
}  // namespace triptych
