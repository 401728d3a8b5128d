// Where depths are equal the lower draw rank wins, whoever was drawn when.
#include "render/gl/renderer.hpp"
#include "residency/load_on_demand.hpp"
#include "tests/render/rig.hpp"
#include "tests/support/small_pack.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

/// Two squares in one plane under a root: the first red, the second green.
test::SmallPack two_coplanar_squares() {
  test::SmallPack pack = test::small_pack();
  Skeleton& skeleton = pack.skeleton;
  pack.chunks = {test::grid_chunk({0, 0, 0}, 1, 64, 0, 0), test::grid_chunk({0, 0, 0}, 1, 64, 0, 1)};
  pack.chunk_lattices = {0, 0};
  skeleton.scene_nodes = {
      {.box = {{0, 0, 0}, {64, 64, 0}},
       .first_child = 1,
       .child_count = 2,
       .first_drawable = 0,
       .drawable_count = 0},
      {.box = {{0, 0, 0}, {64, 64, 0}}, .parent = 0, .first_drawable = 0, .drawable_count = 1},
      {.box = {{0, 0, 0}, {64, 64, 0}}, .parent = 0, .first_drawable = 1, .drawable_count = 1}};
  skeleton.placements = {{0, 0}, {1, 0}};
  skeleton.drawables = {
      {.error = 0, .scene_node = 1, .first_placement = 0, .placement_count = 1, .triangles = 2},
      {.error = 0, .scene_node = 2, .first_placement = 1, .placement_count = 1, .triangles = 2}};
  return pack;
}

View view_of_the_squares() {
  View view{
      .camera = {.eye = {3, 3.5, 12}, .target = {4, 4, 0}, .up = {0, 1, 0}}, .width = 200, .height = 160};
  set_field_of_view(view.camera, 60, 200.0 / 160);
  return view;
}

size_t reddish(const std::vector<uint8_t>& colors) {
  size_t count = 0;
  for (size_t i = 0; i < colors.size(); i += 4) count += colors[i] > 2 * colors[i + 1];
  return count;
}

size_t greenish(const std::vector<uint8_t>& colors) {
  size_t count = 0;
  for (size_t i = 0; i < colors.size(); i += 4) count += colors[i + 1] > 2 * colors[i];
  return count;
}

TEST(DepthOrder, the_lower_draw_rank_wins_at_equal_depth) {
  const Pack pack(test::write_pack(two_coplanar_squares()));
  for (const StrategyKind cull : {StrategyKind::occlusion, StrategyKind::frustum, StrategyKind::none}) {
    LocalPipeline pipeline(pack, {.width = 200, .height = 160, .cull = cull, .device = test::device()});
    for (uint32_t frame = 0; frame < 3; ++frame) {
      pipeline.draw({frame, {view_of_the_squares(), 1}});
      EXPECT_GT(reddish(pipeline.target().read_colors()), 1000u);
      EXPECT_EQ(greenish(pipeline.target().read_colors()), 0u);
    }
  }
}

TEST(DepthOrder, the_order_of_drawing_shows_where_a_device_says_that_it_matters) {
  const Pack pack(test::write_pack(two_coplanar_squares()));
  PackDevice device(pack, test::device());
  PictureStage picture(device.device(), 200, 160);
  picture.begin(FrameView(pack.skeleton(), {view_of_the_squares()}));
  picture.draw(std::array<DrawableId, 2>{1, 0});
  picture.finish();
  const size_t red = reddish(picture.target().read_colors()),
               green = greenish(picture.target().read_colors());
  if (device.device().order_matters()) {
    EXPECT_EQ(red, 0u);
    EXPECT_GT(green, 1000u);
  } else {
    EXPECT_GT(red, 1000u);
    EXPECT_EQ(green, 0u);
  }
}

TEST(DepthOrder, a_drawable_that_coincides_with_an_occluder_counts_as_visible) {
  const Pack pack(test::write_pack(two_coplanar_squares()));
  LocalPipeline pipeline(pack, {.width = 200, .height = 160, .device = test::device()});
  for (uint32_t frame = 0; frame < 3; ++frame) {
    EXPECT_EQ(pipeline.draw({frame, {view_of_the_squares(), 1}}).visible, (VisibleSet{0, 1}));
  }
}

TEST(DepthOrder, depth_and_colour_passes_of_opengl_meet_in_every_pixel) {
  if (!test::on_gl()) GTEST_SKIP() << "the rasteriser has one pass";
  const Pack pack(test::write_pack(test::small_pack()));
  const Hierarchy hierarchy(pack.skeleton());
  LoadOnDemand residency(pack);
  LevelsRepresentation levels(hierarchy);
  Renderer renderer(pack.skeleton(), levels, residency);
  const View view = view_of_the_squares();
  const FrameView frame_view(pack.skeleton(), {view, 0.01});
  renderer.set_view(frame_view);
  std::vector<std::vector<float>> depths;
  for (const TargetKind kind : {TargetKind::depth_only, TargetKind::color, TargetKind::item}) {
    const Framebuffer target(kind, view.width, view.height);
    target.clear();
    std::vector<DrawableId> transparent;
    renderer.draw(select_cut(frame_view).drawables, target, transparent);
    EXPECT_TRUE(transparent.empty());
    depths.push_back(target.read_depths());
  }
  EXPECT_GT(std::count_if(depths[0].begin(), depths[0].end(), [](float depth) { return depth > 0; }), 1000);
  EXPECT_EQ(depths[0], depths[1]);
  EXPECT_EQ(depths[0], depths[2]);
}

}  // namespace
}  // namespace triptych
