// The exhibition and its twins: the same triangles, and each effect in the files that are to call for it
// alone.
#include "samples/effects/effects.hpp"

#include "tests/samples/sample_files.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace triptych {
namespace {

struct Calls {
  bool transparency = false, vertex_colours = false, smooth_normals = false;
  bool operator==(const Calls&) const = default;
};

Calls calls_of(const Model& model) {
  return {std::ranges::any_of(model.materials, [](const Material& m) { return m.base_color.a < 1; }),
          std::ranges::any_of(model.meshes, [](const Mesh& mesh) { return mesh.has_colors(); }),
          std::ranges::any_of(model.meshes, [](const Mesh& mesh) { return mesh.has_normals(); })};
}

TEST(EffectsSample, has_each_effect_in_the_files_that_call_for_it_and_the_same_triangles_in_all) {
  const Folder folder("effects");
  const EffectsReport report = make_effects(folder.path());
  ASSERT_EQ(report.files.size(), 5u);
  for (const EffectsFile& file : report.files) {
    const Model model = read_whole(folder.path() / file.name);
    EXPECT_EQ(model.placed_triangles(), report.triangles) << file.name;
    EXPECT_EQ(model.instances.size(), report.objects) << file.name;
    const Calls expected{file.effects == "all" || file.effects == "transparency",
                         file.effects == "all" || file.effects == "vertex-colours",
                         file.effects == "all" || file.effects == "smooth-normals"};
    EXPECT_EQ(calls_of(model), expected) << file.name;
  }
  for (const char* path : {"walk.json", "fly.json", "spin.json", "jump.json"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / path)) << path;
}

}  // namespace
}  // namespace triptych
