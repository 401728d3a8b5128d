// Shading normals of files and of levels: only where something calls for them, and what they are for.
#include "lod/cut.hpp"
#include "tests/render/closed_scenes.hpp"
#include "tests/support/awkward_meshes.hpp"
#include "tests/support/smoothed.hpp"

#include <algorithm>
#include <cmath>

namespace triptych {
namespace {

using test::pack_of;
using test::smoothed;

constexpr int side = 128;

View view_of_ball(double distance) {
  View view{.camera = {.eye = {0.3 * distance, 0.2 * distance, distance}, .target = {0, 0, 0}, .near = 0.1},
            .width = side,
            .height = side};
  set_field_of_view(view.camera, 40, 1);
  return view;
}

struct Shown {
  std::vector<uint8_t> colors;
  std::vector<EffectUse> effects;
};

Shown shown(const Pack& pack, const FrameState& state) {
  LocalPipeline pipeline(pack, {.width = side, .height = side, .device = test::device()});
  const FrameRecord& record = pipeline.draw({0, state});
  Shown shown{{}, record.effects};
  shown.colors = pipeline.target().read_colors();
  return shown;
}

Effects without_smooth_normals() {
  Effects effects = Effects::none();
  for (const Effect effect : all_effects) {
    if (effect != Effect::smooth_normals) effects.add(effect);
  }
  return effects;
}

/// The mean difference of pixels that show something in both, of 255.
double apart(const std::vector<uint8_t>& one, const std::vector<uint8_t>& other) {
  constexpr int background = 219;
  double sum = 0;
  size_t count = 0;
  for (size_t i = 0; i < one.size(); i += 4) {
    if (one[i] == background || other[i] == background) continue;
    sum += std::abs(int{one[i]} - int{other[i]});
    ++count;
  }
  return sum / static_cast<double>(std::max<size_t>(count, 1));
}

TEST(SmoothNormals, show_where_files_have_them_and_can_be_switched_off) {
  const auto plain = pack_of(awkward::model_of({awkward::sphere(10, 2)}));
  const auto smooth = pack_of(awkward::model_of({smoothed(awkward::sphere(10, 2))}));
  EXPECT_EQ(smooth->skeleton().effects.front(), effect_name_in_pack(Effect::smooth_normals));
  const FrameState state{view_of_ball(7), 0};
  const Shown faceted = shown(*plain, state), round = shown(*smooth, state);
  EXPECT_TRUE(faceted.effects.empty()) << "a pass runs only where something calls for it";
  ASSERT_EQ(round.effects.size(), 1u);
  EXPECT_EQ(round.effects.front().effect, Effect::smooth_normals);
  EXPECT_GT(apart(faceted.colors, round.colors), 2);
  FrameState off = state;
  off.effects = without_smooth_normals();
  const Shown switched_off = shown(*smooth, off);
  EXPECT_EQ(switched_off.colors, faceted.colors);
  EXPECT_TRUE(switched_off.effects.empty());
}

TEST(SmoothNormals, make_no_facet_of_a_ball_much_brighter_than_a_finer_ball_is) {
  const auto coarse = pack_of(awkward::model_of({smoothed(awkward::sphere(12, 2))}));
  const auto fine = pack_of(awkward::model_of({awkward::sphere(96, 2)}));
  const FrameState state{view_of_ball(7), 0};
  EXPECT_LT(apart(shown(*coarse, state).colors, shown(*fine, state).colors), 1.5);
}

TEST(SmoothNormals, that_say_what_facets_say_leave_the_pack_as_it_is) {
  Mesh box{"box", {}, {}};
  const Mesh shared = awkward::box({0, 0, 0}, {1, 2, 3});
  for (const Triangle& triangle : shared.triangles) {
    Triangle own{{}, triangle.material};
    std::array<glm::dvec3, 3> at;
    for (size_t k = 0; k < 3; ++k) at[k] = shared.positions[triangle.vertices[k]];
    for (size_t k = 0; k < 3; ++k) {
      own.vertices[k] = static_cast<uint32_t>(box.positions.size());
      box.positions.push_back(at[k]);
      box.normals.push_back(to_vertex_normal(glm::cross(at[1] - at[0], at[2] - at[0])));
    }
    box.triangles.push_back(own);
  }
  Mesh bare = box;
  bare.normals.clear();
  const auto with = pack_of(awkward::model_of({box})), without = pack_of(awkward::model_of({bare}));
  EXPECT_EQ(with->content_hash(), without->content_hash());
  EXPECT_FALSE(has_normals(with->skeleton().effects));
}

/// How far levels of a finely faceted ball are from all of it.
double shade_of_levels(const Model& model, bool keep_shade) {
  Kept keep;
  keep.shade = keep_shade;
  const auto pack = pack_of(model, Simplifier::collapse, keep);
  EXPECT_EQ(has_normals(pack->skeleton().effects), keep_shade);
  const Shown all = shown(*pack, {view_of_ball(30), 0}), levels = shown(*pack, {view_of_ball(30), 8});
  EXPECT_TRUE(levels.effects.empty()) << "they are a part of the levels";
  return apart(all.colors, levels.colors);
}

TEST(LevelNormals, keep_the_shade_of_a_surface_at_coarse_levels) {
  const Model ball = awkward::model_of({awkward::sphere(48, 10)});
  const double kept = shade_of_levels(ball, true), facets = shade_of_levels(ball, false);
  testing::Test::RecordProperty("kept", std::to_string(kept));
  testing::Test::RecordProperty("facets", std::to_string(facets));
  EXPECT_LT(kept, 0.75 * facets);
}

}  // namespace
}  // namespace triptych
