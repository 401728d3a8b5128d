// Closed surfaces in many parts, seen from inside at mixed levels of detail: a pixel of the background would
// be a hole.
#include "lod/preprocess/build.hpp"
#include "tests/render/rig.hpp"
#include "tests/support/awkward_meshes.hpp"

#include <filesystem>
#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <set>

namespace triptych {
namespace {

/// A sphere with waves on it: closed, and nowhere flat.
Mesh wavy_sphere(uint32_t rings) {
  Mesh mesh = awkward::sphere(rings, 10);
  for (glm::dvec3& position : mesh.positions) {
    const glm::dvec3 p = position;
    position *= 1 + 0.05 * std::sin(1.3 * p.x) * std::cos(1.7 * p.y) * std::sin(1.1 * p.z + 0.4);
  }
  return mesh;
}

class ClosedBorders : public testing::Test {
 protected:
  ClosedBorders() : context(test_context()) {
    const auto file = std::filesystem::path(testing::TempDir()) /
                      ("triptych_closed_" + std::to_string(::getpid()) + ".tpk");
    BuildOptions options;
    options.part_triangles = 600;
    options.leaf_triangles = 1000;
    options.hlod_triangles = 120;
    options.bucket_triangles = 9000;  // borders between buckets and borders within them
    build_pack(awkward::model_of({wavy_sphere(120)}), options, file);
    pack = std::make_unique<Pack>(file);
    std::filesystem::remove(file);
  }

  /// Drawables of how many levels of the hierarchy the cut mixes.
  size_t mixed_levels(const Cut& cut) const {
    std::set<std::pair<uint32_t, uint32_t>> levels;
    for (const DrawableId id : cut.drawables) {
      const Skeleton& skeleton = pack->skeleton();
      const SceneNode& node = skeleton.scene_nodes[skeleton.drawables[id].scene_node];
      levels.insert({node.child_count == 0, id - node.first_drawable});
    }
    return levels.size();
  }

  Context& context;
  std::unique_ptr<Pack> pack;
};

TEST_F(ClosedBorders, no_pixel_shows_what_is_behind_a_closed_surface_at_any_mix_of_levels) {
  Fallback fallback(
      *pack, {.width = 320, .height = 240, .cull = CullMode::frustum, .batches = {}, .item_buffer = true});
  size_t holes = 0, mixed = 0, frames = 0;
  for (const double pixel_error : {0.5, 2.0, 8.0, 24.0}) {
    for (int i = 0; i < 24; ++i) {
      const double turn = i * 0.71;
      const glm::dvec3 eye = 7.5 * glm::dvec3(std::cos(turn), 0.6 * std::sin(2.3 * turn), std::sin(turn));
      const glm::dvec3 target =
          eye + glm::dvec3(std::sin(3 * turn), 0.3 * std::cos(turn), std::cos(5 * turn));
      View view{.camera = {.eye = eye, .target = target, .near = 1e-3}, .width = 320, .height = 240};
      set_field_of_view(view.camera, 90, 320.0 / 240);
      const FrameRequest frame{
          .number = static_cast<uint32_t>(frames++), .view = view, .pixel_error = pixel_error};
      mixed += mixed_levels(select_cut(pack->skeleton(), frame.view, pixel_error)) > 1;
      fallback.draw(frame);
      for (const uint32_t item : fallback.target().read_items()) holes += item == 0;
    }
  }
  EXPECT_EQ(holes, 0u);
  EXPECT_GT(mixed, frames / 2);
}

}  // namespace
}  // namespace triptych
