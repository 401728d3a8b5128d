// Sections: what is cut away hides nothing, culled pictures are the un-culled ones under any section, and
// what is solid shows its cut surface.
#include "base/inject.hpp"
#include "lod/sectioned.hpp"
#include "preprocess/build.hpp"
#include "scene/solid_objects.hpp"
#include "tests/render/random_sections.hpp"
#include "tests/support/awkward_meshes.hpp"
#include "visibility/cap_look.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace triptych {
namespace {

class UnderRandomSections : public testing::TestWithParam<std::string> {};

TEST_P(UnderRandomSections, culled_pictures_equal_the_un_culled_ones_in_every_pixel) {
  const auto [drawn, cut] = compare_under_sections(scenes::pack(GetParam()), test::on_gl() ? 60 : 720);
  RecordProperty("drawn", std::to_string(drawn));
  RecordProperty("cut", std::to_string(cut));
  EXPECT_LE(drawn, cut);
}

INSTANTIATE_TEST_SUITE_P(Scenes, UnderRandomSections,
                         testing::Values("room", "flat", "coplanar", "world", "instances", "storeys",
                                         "painted"),
                         [](const auto& scene) { return scene.param; });

/// A wall, and a box behind it: both solid.
Model wall_and_box() {
  Mesh wall = awkward::box({-4, 0, -1}, {4, 3, 1}, 0), behind = awkward::box({-1, 0.5, -9}, {1, 2, -7}, 1);
  Model model = awkward::model_of({wall, behind});
  model.materials = {{.base_color = {0.75, 0.5, 0.25, 1}}, {.base_color = {0.25, 0.75, 0.5, 1}}};
  return model;
}

class CutSurfaces : public testing::Test {
 protected:
  static constexpr size_t wall = 0, box = 1;  ///< of the palette
  static const Pack& pack() {
    static const Pack built = [] {
      const std::filesystem::path file =
          std::filesystem::path(testing::TempDir()) / fmt::format("triptych_cut_surfaces_{}.tpk", getpid());
      build_pack(wall_and_box(), {.part_triangles = 64, .leaf_triangles = 12}, file);
      return Pack(file);
    }();
    return built;
  }
  static FrameState state() {
    View view{
        .camera = {.eye = {0, 1.5, 12}, .target = {0, 1.5, 0}, .near = 0.1}, .width = 120, .height = 90};
    set_field_of_view(view.camera, 50, 4.0 / 3);
    return {view, 1};
  }
};

struct Shown {
  glm::ivec3 middle;
  VisibleSet visible;
};

/// After some frames of it, so that what is represented counts.
Shown show(LocalPipeline& pipeline, const FrameState& state) {
  for (uint32_t i = 0; i < 3; ++i) pipeline.draw({i, state});
  const FrameTarget& target = pipeline.target();
  const std::vector<uint8_t> colors = target.read_colors();
  const size_t at = 4 * static_cast<size_t>(target.height() / 2 * target.width() + target.width() / 2);
  return {{colors[at], colors[at + 1], colors[at + 2]}, pipeline.draw({3, state}).visible};
}

TEST_F(CutSurfaces, show_where_a_side_goes_through_something_solid) {
  LocalPipeline pipeline(pack(), {.width = 120, .height = 90, .device = test::device()});
  for (const bool orthographic : {false, true}) {
    for (const uint32_t samples : {1u, 4u}) {
      FrameState frame = state();
      if (orthographic) set_orthographic_height(frame.view.camera, 12, 4.0 / 3);
      frame.samples = samples;
      frame.edges = samples == 4;
      const Shown whole = show(pipeline, frame);
      EXPECT_TRUE(alike(whole.middle, lit(pack(), wall, {0, 0, 1}, frame, 1)));
      frame.section.add_plane({{0, 0, -1}, 0}, "test");
      const Shown cut = show(pipeline, frame);
      EXPECT_TRUE(alike(cut.middle, lit(pack(), wall, {0, 0, 1}, frame, cap_tone)))
          << cut.middle.x << " " << cut.middle.y << " " << cut.middle.z;
      EXPECT_EQ(cut.visible.size(), 1u) << "the wall still hides what is behind it";
    }
  }
}

TEST_F(CutSurfaces, are_hatched_and_on_each_side_of_a_section_the_other_way) {
  LocalPipeline pipeline(pack(), {.width = 120, .height = 90, .device = test::device()});
  const CapHatching hatching(90);
  for (const uint32_t side : {0u, 1u}) {
    FrameState frame = state();
    if (side == 1) frame.section.add_plane({{0, 1, 0}, -9}, "test");
    frame.section.add_plane({{0, 0, -1}, 0}, "test");
    pipeline.draw({0, frame});
    const std::vector<uint8_t> colors = pipeline.target().read_colors();
    const CapInk ink = cap_ink({0.75, 0.5, 0.25});
    const glm::dvec3 plain = lit(pack(), wall, {0, 0, 1}, frame, cap_tone);
    size_t strokes = 0;
    for (int32_t y = 40; y < 48; ++y) {
      for (int32_t x = 50; x < 66; ++x) {
        const auto at = 4 * static_cast<size_t>(y * 120 + x);
        const bool inked = hatching.inked(x, y, side);
        const glm::ivec3 wanted(glm::round(inked ? plain * double{ink.scale} + 255.0 * ink.add : plain));
        EXPECT_TRUE(alike({colors[at], colors[at + 1], colors[at + 2]}, wanted)) << x << " " << y;
        strokes += inked;
      }
    }
    EXPECT_EQ(strokes, 8u * 16 / CapHatching::period);
  }
  EXPECT_TRUE(hatching.inked(40, 40, 0) && hatching.inked(41, 39, 0) && !hatching.inked(41, 41, 0));
  EXPECT_TRUE(hatching.inked(40, 40, 1) && hatching.inked(41, 41, 1) && !hatching.inked(41, 39, 1));
}

TEST(CapInk, is_brighter_on_dark_materials_and_darker_on_bright_ones) {
  for (const float tone : {0.0f, 0.1f, 0.2f, 0.25f, 0.6f, 1.0f}) {
    const CapInk ink = cap_ink(glm::vec3(tone));
    const float surface = tone * cap_tone, stroke = surface * ink.scale + ink.add;
    EXPECT_GT(std::abs(stroke - surface), 0.08f) << tone;
    EXPECT_EQ(stroke > surface, tone < dark_material) << tone;
    EXPECT_LE(stroke, 1);
  }
}

TEST_F(CutSurfaces, of_what_is_cut_obliquely_have_the_light_of_the_side) {
  LocalPipeline pipeline(pack(), {.width = 120, .height = 90, .device = test::device()});
  FrameState frame = state();
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, -0.2, -1));
  frame.section.add_plane({normal, glm::dot(normal, glm::dvec3(0, 1.5, 0.1))}, "test");
  EXPECT_TRUE(alike(show(pipeline, frame).middle, lit(pack(), wall, normal, frame, cap_tone)));
}

TEST_F(CutSurfaces, do_not_show_of_what_is_cut_away_and_it_hides_nothing) {
  LocalPipeline pipeline(pack(), {.width = 120, .height = 90, .device = test::device()});
  FrameState frame = state();
  ASSERT_EQ(show(pipeline, frame).visible.size(), 1u);
  frame.section.add_plane({{0, 0, -1}, 2}, "test");
  const Shown behind = show(pipeline, frame);
  EXPECT_TRUE(alike(behind.middle, lit(pack(), box, {0, 0, 1}, frame, 1)));
  EXPECT_EQ(behind.visible.size(), 1u);
  frame.section = {};
  frame.section.set_box({{-9, -9, -8}, {9, 9, -2}}, "test");
  EXPECT_TRUE(alike(show(pipeline, frame).middle, lit(pack(), box, {0, 0, 1}, frame, 1)));
  frame.section.set_box({{-9, -9, -8.5}, {9, 9, -8}}, "test");
  EXPECT_TRUE(alike(show(pipeline, frame).middle, lit(pack(), box, {0, 0, 1}, frame, cap_tone)));
}

TEST_F(CutSurfaces, end_where_another_side_cuts_them_off) {
  LocalPipeline pipeline(pack(), {.width = 120, .height = 90, .device = test::device()});
  for (const bool by_a_box : {false, true}) {
    FrameState frame = state();
    frame.view.camera.target = {-3, 1.5, 0};  // the ray leaves x >= -1 long before it comes in at z = 0
    if (by_a_box) {
      frame.section.set_box({{-1, -9, -9}, {9, 9, 0}}, "test");
    } else {
      frame.section.add_plane({{0, 0, -1}, 0}, "test");
      frame.section.add_plane({{1, 0, 0}, -1}, "test");
    }
    EXPECT_EQ(show(pipeline, frame).middle,
              glm::ivec3(background_bytes[0], background_bytes[1], background_bytes[2]));
    frame.view.camera.target = {0, 1.5, 0};
    EXPECT_TRUE(alike(show(pipeline, frame).middle, lit(pack(), wall, {0, 0, 1}, frame, cap_tone)));
  }
}

TEST_F(CutSurfaces, show_to_an_eye_that_is_where_something_was_cut_away) {
  LocalPipeline pipeline(pack(), {.width = 120, .height = 90, .device = test::device()});
  FrameState frame = state();
  frame.view.camera.eye = {0, 1.5, 0.5};  // in the wall
  frame.section.add_plane({{0, 0, -1}, 0}, "test");
  EXPECT_TRUE(alike(show(pipeline, frame).middle, lit(pack(), wall, {0, 0, 1}, frame, cap_tone)));
  frame.section = {};
  EXPECT_TRUE(alike(show(pipeline, frame).middle, lit(pack(), wall, {0, 0, 1}, frame, 1)))
      << "cut open by the near plane it shows what is within";
}

/// Layers of one mesh, from x = -4 to 4, that touch in whole faces: the first and the third alike.
Model layered_wall() {
  Mesh wall{"layers", {}, {}};
  for (int i = 0; i < 3; ++i) {
    const Mesh layer = awkward::box({-4, 0, -1 + 0.5 * i}, {4, 3, -0.5 + 0.5 * i}, i == 1 ? 1 : 0);
    const auto first = static_cast<uint32_t>(wall.positions.size());
    wall.positions.insert(wall.positions.end(), layer.positions.begin(), layer.positions.end());
    for (Triangle triangle : layer.triangles) {
      for (uint32_t& vertex : triangle.vertices) vertex += first;
      wall.triangles.push_back(triangle);
    }
  }
  Model model = awkward::model_of({wall});
  model.materials = {{.base_color = {0.75, 0.5, 0.25, 1}}, {.base_color = {0.25, 0.75, 0.5, 1}}};
  return model;
}

TEST(CutLayers, of_one_mesh_each_show_their_own_cut_surface) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / fmt::format("triptych_cut_layers_{}.tpk", getpid());
  build_pack(layered_wall(), {.part_triangles = 64, .leaf_triangles = 64}, file);
  const Pack pack(file);
  std::filesystem::remove(file);
  EXPECT_EQ(count_solids(pack).solid_placements, 1u);
  LocalPipeline pipeline(pack, {.width = 120, .height = 90, .device = test::device()});
  View view{.camera = {.eye = {12, 1.5, 0}, .target = {0, 1.5, 0}, .near = 0.1}, .width = 120, .height = 90};
  set_field_of_view(view.camera, 50, 4.0 / 3);
  for (const double z : {-0.75, -0.25, 0.25}) {
    FrameState frame{view, 1};
    frame.view.camera.eye.z = frame.view.camera.target.z = z;
    frame.section.add_plane({{-1, 0, 0}, 0}, "test");
    const size_t color = z == -0.25 ? 1 : 0;
    EXPECT_TRUE(alike(show(pipeline, frame).middle, lit(pack, color, {0, 0, 1}, frame, cap_tone))) << z;
    EXPECT_EQ(count_sectioned(pipeline.hierarchy(), FrameView(pack.skeleton(), frame),
                              pipeline.draw({4, frame}).visible),
              (SectionedCounts{.placements = 1, .open = 0}));
  }
}

TEST(CutOpen, is_counted_where_what_is_cut_is_not_solid) {
  Model model = wall_and_box();
  model.meshes[0].triangles.pop_back();
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / fmt::format("triptych_cut_open_{}.tpk", getpid());
  build_pack(std::move(model), {.part_triangles = 64, .leaf_triangles = 12}, file);
  const Pack pack(file);
  std::filesystem::remove(file);
  LocalPipeline pipeline(pack, {.width = 120, .height = 90, .device = test::device()});
  View view{.camera = {.eye = {0, 1.5, 12}, .target = {0, 1.5, 0}, .near = 0.1}, .width = 120, .height = 90};
  set_field_of_view(view.camera, 50, 4.0 / 3);
  EXPECT_EQ(count_solids(pack).placements, 2u);
  EXPECT_EQ(count_solids(pack).solid_placements, 1u);
  FrameState frame{view, 1};
  const auto counted = [&] {
    pipeline.draw({0, frame});
    return count_sectioned(pipeline.hierarchy(), FrameView(pack.skeleton(), frame),
                           pipeline.draw({1, frame}).visible);
  };
  EXPECT_EQ(counted(), SectionedCounts());
  frame.section.add_plane({{0, 0, -1}, 0}, "test");
  EXPECT_EQ(counted(), (SectionedCounts{.placements = 1, .open = 1})) << "the wall";
  frame.section = {};
  frame.section.add_plane({{0, 0, -1}, 8}, "test");
  EXPECT_EQ(counted(), (SectionedCounts{.placements = 1, .open = 0})) << "the box";
}

TEST(CutAway, that_still_hides_what_is_behind_it_is_noticed) {
  const Pack& pack = scenes::pack("room");
  const Box box = pack.skeleton().lattice().box(pack.skeleton().scene_nodes.front().box);
  const std::vector<View> views = scenes::random_views(pack.skeleton(), 72, 56, 40, 23);
  const auto differing = [&] {
    Rig rig(pack, 72, 56);
    scenes::Random random(17);
    size_t pixels = 0;
    for (size_t i = 0; i < views.size(); ++i) {
      FrameState state{views[i / 2 * 2], 1};
      if (i % 2 == 1) state.section = random_section(box, random);
      pixels += rig.draw({static_cast<uint32_t>(i), state}).differing_pixels;
    }
    return pixels;
  };
  EXPECT_EQ(differing(), 0u);
  ASSERT_TRUE(inject("cut-occludes"));
  EXPECT_GT(differing(), 100u);
  clear_injected();
}

}  // namespace
}  // namespace triptych
