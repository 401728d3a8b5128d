// Closed scenes, seen from inside at random mixes of levels: a pixel of the background is a hole.
#pragma once

#include "preprocess/build.hpp"
#include "tests/render/rig.hpp"

#include <filesystem>
#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <random>

namespace triptych::test {

inline std::unique_ptr<Pack> built(const Model& model, const BuildOptions& options) {
  const auto file =
      std::filesystem::path(testing::TempDir()) / ("triptych_closed_" + std::to_string(::getpid()) + ".tpk");
  build_pack(model, options, file);
  auto pack = std::make_unique<Pack>(file);
  std::filesystem::remove(file);
  return pack;
}

inline std::unique_ptr<Pack> pack_of(const Model& model, Simplifier simplifier = Simplifier::collapse,
                                     Kept keep = {}, const LightOptions& light = {}) {
  BuildOptions options;
  options.part_triangles = 600;
  options.leaf_triangles = 1000;
  options.hlod_triangles = 120;
  options.bucket_triangles = 9000;  // borders between buckets and borders within them
  options.simplify.simplifier = simplifier;
  options.keep = keep;
  options.light = light;
  return built(model, options);
}

/// A drawable for every part of the model, at random: any depth, any level, whatever its neighbours are.
inline std::vector<DrawableId> random_mix(const Skeleton& skeleton, std::mt19937& random) {
  std::vector<DrawableId> mix;
  std::vector<SceneNodeId> open = {0};
  const auto stop = static_cast<uint32_t>(2 + random() % 5);  // one in so many inner nodes is drawn as it is
  while (!open.empty()) {
    const SceneNode& node = skeleton.scene_nodes[open.back()];
    open.pop_back();
    if (node.child_count == 0 || (random() % stop == 0 && node.drawable_count > 0)) {
      mix.push_back(node.first_drawable + static_cast<uint32_t>(random()) % node.drawable_count);
    } else {
      for (uint32_t i = 0; i < node.child_count; ++i) open.push_back(node.first_child + i);
    }
  }
  return mix;
}

/// Looks around from a place inside the sphere, whose radius is 10, and inside of what its coarsest levels
/// make of it, which are off by up to 5.
inline View inside(double turn, int width, int height) {
  const glm::dvec3 eye = 4.0 * glm::dvec3(std::cos(turn), 0.6 * std::sin(2.3 * turn), std::sin(turn));
  const glm::dvec3 target = eye + glm::dvec3(std::sin(3 * turn), 0.3 * std::cos(turn), std::cos(5 * turn));
  View view{.camera = {.eye = eye, .target = target, .near = 1e-3}, .width = width, .height = height};
  set_field_of_view(view.camera, 90, double(width) / height);
  return view;
}

/// Pixels of the background in pictures of random mixes, seen from inside.
inline size_t holes_of_random_mixes(const Pack& pack, int mixes, const Affine& placed = Affine(1)) {
  constexpr int width = 320, height = 240;
  LocalPipeline pipeline(pack, {.width = width,
                                .height = height,
                                .cull = StrategyKind::frustum,
                                .device = device(),
                                .item_buffer = true});
  std::mt19937 random(21);
  size_t holes = 0;
  for (int i = 0; i < mixes; ++i) {
    View view = inside(i * 0.71, width, height);
    for (glm::dvec3* point : {&view.camera.eye, &view.camera.target}) *point = placed * glm::dvec4(*point, 1);
    const std::vector<DrawableId> mix = random_mix(pack.skeleton(), random);
    pipeline.picture().begin(FrameView(pack.skeleton(), {view}), static_cast<uint32_t>(i));
    pipeline.picture().draw(mix);
    pipeline.picture().finish();
    for (const uint32_t item : pipeline.target().read_items()) holes += item == 0;
  }
  return holes;
}

}  // namespace triptych::test
