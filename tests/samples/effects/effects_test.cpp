// The exhibition and its twins: the same triangles, and each effect in the files that are to call for it
// alone.
#include "samples/effects/effects.hpp"

#include "model/flatten.hpp"
#include "tests/samples/sample_files.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace triptych {
namespace {

struct Calls {
  bool transparency = false, vertex_colours = false, smooth_normals = false, textures = false,
       emission = false, motion = false, lights = false;
  bool operator==(const Calls&) const = default;
};

Calls calls_of(const Model& model) {
  return {std::ranges::any_of(model.materials, [](const Material& m) { return m.base_color.a < 1; }),
          std::ranges::any_of(model.meshes, [](const Mesh& mesh) { return mesh.has_colors(); }),
          std::ranges::any_of(model.meshes, [](const Mesh& mesh) { return mesh.has_normals(); }),
          std::ranges::any_of(model.materials, [](const Material& m) { return m.texture != no_id; }) &&
              std::ranges::any_of(model.materials, [](const Material& m) { return m.cutoff > 0; }),
          std::ranges::any_of(model.materials, [](const Material& m) { return m.emission != glm::vec3(0); }),
          model.motion.joints.size() == 2,
          !model.lights.empty()};
}

TEST(EffectsSample, has_each_effect_in_the_files_that_call_for_it_and_the_same_triangles_in_all) {
  const Folder folder("effects");
  const EffectsReport report = make_effects(folder.path());
  ASSERT_EQ(report.files.size(), 10u);
  for (const EffectsFile& file : report.files) {
    const Model model = read_whole(folder.path() / file.name);
    EXPECT_EQ(model.placed_triangles(), report.triangles) << file.name;
    EXPECT_EQ(flattened(model).instances.size(), report.objects) << file.name;
    const auto calls_for = [&](const char* effect) {
      return file.effects == "all" || file.effects == effect;
    };
    const Calls expected{calls_for("transparency"),   calls_for("vertex-colours"),
                         calls_for("smooth-normals"), calls_for("textures"),
                         calls_for("emission"),       calls_for("moving-instances"),
                         calls_for("baked-light")};
    EXPECT_TRUE(model.report.warnings.empty()) << file.name << ": " << model.report.warnings.front();
    EXPECT_EQ(calls_of(model), expected) << file.name;
  }
  for (const char* path : {"walk.json", "fly.json", "spin.json", "jump.json"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / path)) << path;
}

}  // namespace
}  // namespace triptych
