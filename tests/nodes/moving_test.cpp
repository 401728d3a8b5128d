// Moving instances through the whole pipeline: pictures against those of models that stand as an independent
// evaluation of the motion puts them, culling against none, and what a frame evaluates.
#include "nodes/local_pipeline.hpp"
#include "preprocess/build.hpp"
#include "preprocess/check/check.hpp"
#include "scene/moving_parts.hpp"
#include "tests/support/awkward_meshes.hpp"
#include "tests/support/pictures.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/test_device.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>
#include <unistd.h>

namespace triptych {
namespace {

constexpr double length = 3;  // seconds, of the clip

/// Where the two movers are, by other arithmetic than the program's.
glm::dmat4 arm_at(double time) {
  const double now = std::fmod(time, length);
  const double angle = now < 2 ? now : 2;  // a radian a second, and then it rests
  return glm::rotate(glm::translate(glm::dmat4(1), {0.0, 0.0, 1.0}), angle, {0.0, 0.0, 1.0});
}
glm::dmat4 hand_at(double time) {
  const double now = std::fmod(time, length);
  const double way = 1 + now / length, size = now < 1 ? 1 : 0.5;
  return arm_at(time) * glm::scale(glm::translate(glm::dmat4(1), {way, 0.0, 0.25 * way}), glm::dvec3(size));
}

std::vector<Mesh> meshes() {
  std::vector<Mesh> meshes = {awkward::sphere(10, 0.4), awkward::box({-2, -2, -0.1}, {4, 2, 0})};
  meshes[0].triangles.front().material = 0;
  return meshes;
}

Model standing() {
  Model model;
  model.materials = {{glm::vec4(0.9, 0.3, 0.1, 1)}, {glm::vec4(0.2, 0.5, 0.9, 1)}};
  model.meshes = meshes();
  for (Triangle& triangle : model.meshes[1].triangles) triangle.material = 1;
  model.instances = {{1, Affine(1)}, {0, Affine(glm::translate(glm::dmat4(1), {3.0, 0.0, 0.5}))}};
  return model;
}

/// An arm of two spheres that turns, a hand on it that slides and shrinks, and a floor that stands.
Model moving() {
  Model model = standing();
  const double half = 1;  // of two radians
  model.motion.tracks = {
      {Interpolation::linear, 4, length, {0, 2}, {0, 0, 0, 1, 0, 0, std::sin(half), std::cos(half)}},
      {Interpolation::linear, 3, length, {0, length}, {1, 0, 0.25, 2, 0, 0.5}},
      {Interpolation::step, 3, length, {0, 1}, {1, 1, 1, 0.5, 0.5, 0.5}}};
  MotionJoint arm{.rotation_track = 0}, hand{.parent = 0, .translation_track = 1, .scale_track = 2};
  arm.before[3] = {0, 0, 1};
  model.motion.joints = {arm, hand};
  model.groups.push_back({{{0, Affine(1)}, {0, Affine(glm::translate(glm::dmat4(1), {0.5, 0.0, 0.0}))}}, {}});
  model.groups.push_back({{{0, Affine(1)}}, {}});
  for (uint32_t joint = 0; joint < 2; ++joint) {
    model.group_instances.push_back({joint, transform_at(model.motion, joint, 0)});
    model.group_instances.back().joint = joint;
  }
  return model;
}

Model baked(double time) {
  Model model = standing();
  model.instances.push_back({0, Affine(arm_at(time))});
  model.instances.push_back({0, Affine(glm::translate(arm_at(time), {0.5, 0.0, 0.0}))});
  model.instances.push_back({0, Affine(hand_at(time))});
  return model;
}

std::unique_ptr<Pack> built(Model model, const std::string& name) {
  // Cases of all devices may run side by side.
  const auto file =
      std::filesystem::path(testing::TempDir()) / fmt::format("moving_{}_{}.tpk", name, ::getpid());
  build_pack(std::move(model), {}, file);
  auto pack = std::make_unique<Pack>(file);
  std::filesystem::remove(file);  // it stays open
  return pack;
}

const Pack& pack() {
  static const std::unique_ptr<Pack> pack = built(moving(), "moves");
  return *pack;
}

View view() {
  View view{
      .camera = {.eye = {-3, -4, 3}, .target = {0.6, 0, 0.6}, .up = {0, 0, 1}}, .width = 120, .height = 90};
  set_field_of_view(view.camera, 50, 120.0 / 90);
  view.camera.near = 0.01;
  return view;
}

FrameRequest frame(uint32_t number, double time, double pixel_error = 0) {
  FrameRequest request{number, {view(), pixel_error}};
  request.state.time = time;
  return request;
}

std::vector<uint8_t> picture(const Pack& of, const FrameRequest& request, StrategyKind cull) {
  LocalPipeline pipeline(of, {.width = 120, .height = 90, .cull = cull, .device = test::device()});
  pipeline.draw(request);
  return pipeline.target().read_colors();
}

TEST(Moving, a_pack_says_what_moves_and_is_consistent) {
  const Skeleton& skeleton = pack().skeleton();
  ASSERT_NE(skeleton.moving, nullptr);
  EXPECT_EQ(skeleton.moving->instances.size(), 2u);
  EXPECT_EQ(std::ranges::count(skeleton.effects, "moving instances"), 1);
  for (const SceneNode& node : skeleton.scene_nodes) {
    const auto id = static_cast<SceneNodeId>(&node - skeleton.scene_nodes.data());
    bool moves_below = false;
    for (const MovingInstance& instance : skeleton.moving->instances) {
      for (SceneNodeId up = skeleton.scene_nodes[instance.scene_node].parent; up != no_id;
           up = skeleton.scene_nodes[up].parent)
        moves_below = moves_below || up == id;
    }
    EXPECT_TRUE(!moves_below || node.drawable_count == 0) << "nothing stands for what moves";
  }
  const CheckReport report = check_pack(pack());
  EXPECT_TRUE(report.messages.empty()) << report.messages.front();
}

TEST(Moving, pictures_are_those_of_a_model_that_stands_as_it_is_at_the_time) {
  for (const double time : {0.0, 0.4, 1.0, 1.7, 2.5, 3.0, 100.3}) {
    const auto still = built(baked(time), "baked");
    const size_t differing = test::differing_pixels(picture(pack(), frame(0, time), StrategyKind::frustum),
                                                    picture(*still, frame(0, 0), StrategyKind::frustum));
    // The two are on other lattices: outlines may be a pixel elsewhere, by rounding alone.
    EXPECT_LE(differing, 12u) << "at " << time;
  }
  const auto other = built(baked(0), "baked");
  EXPECT_GT(test::differing_pixels(picture(pack(), frame(0, 1.7), StrategyKind::frustum),
                                   picture(*other, frame(0, 0), StrategyKind::frustum)),
            100u);
}

TEST(Moving, culling_changes_nothing_at_any_time) {
  LocalPipeline culled(
      pack(), {.width = 120, .height = 90, .cull = StrategyKind::occlusion, .device = test::device()});
  LocalPipeline whole(pack(),
                      {.width = 120, .height = 90, .cull = StrategyKind::none, .device = test::device()});
  for (uint32_t i = 0; i < 24; ++i) {
    FrameRequest request = frame(i, i % 5 == 4 ? 1000.1 * i : 0.21 * i, i % 3);
    // Cut surfaces of what moves, too.
    if (i % 4 > 1) request.state.section.add_plane({{0, 1, 0}, 0.05}, "test");
    if (i % 4 == 3) request.state.section.add_plane({{-1, 0, 0}, -0.6}, "test");
    culled.draw(request);
    whole.draw(request);
    ASSERT_EQ(test::differing_pixels(culled.target().read_colors(), whole.target().read_colors()), 0u) << i;
  }
}

TEST(Moving, cut_surfaces_are_those_of_a_model_that_stands) {
  for (const double time : {0.4, 1.7}) {
    const auto still = built(baked(time), "cut");
    FrameRequest cut = frame(0, time);
    cut.state.section.add_plane({{0, 1, 0}, 0.1}, "test");
    const std::vector<uint8_t> open = picture(pack(), cut, StrategyKind::frustum);
    EXPECT_LE(test::differing_pixels(open, picture(*still, cut, StrategyKind::frustum)), 16u) << time;
    EXPECT_GT(test::differing_pixels(open, picture(pack(), frame(0, time), StrategyKind::frustum)), 100u);
  }
}

TEST(Moving, only_what_may_be_seen_is_evaluated_and_only_once_a_time) {
  LocalPipeline pipeline(pack(), {.width = 120, .height = 90, .device = test::device()});
  const auto steps = [](const FrameRecord& record) {
    const auto use = std::ranges::find(record.effects, Effect::motion, &EffectUse::effect);
    return use == record.effects.end() ? uint64_t{0} : use->simulation_steps;
  };
  EXPECT_EQ(steps(pipeline.draw(frame(0, 0.111))), 2u);
  EXPECT_EQ(steps(pipeline.draw(frame(1, 0.111))), 0u) << "the same time again";
  EXPECT_EQ(steps(pipeline.draw(frame(2, 0.222))), 2u);
  FrameRequest away = frame(3, 0.333);
  away.state.view.camera.target = {-9, -12, 3};
  const FrameRecord& record = pipeline.draw(away);
  EXPECT_TRUE(record.effects.empty());
  const auto there = pipeline.draw(frame(4, 0.333));
  EXPECT_EQ(steps(there), 2u) << "right when it comes into view";
  FrameRequest frozen = frame(5, 0.444);
  frozen.state.effects = Effects::none();
  EXPECT_TRUE(pipeline.draw(frozen).effects.empty());
  EXPECT_EQ(picture(pack(), frozen, StrategyKind::occlusion),
            picture(pack(), frame(5, 0), StrategyKind::occlusion));
}

TEST(Moving, what_a_motion_shrinks_to_nothing_is_not_there) {
  Model model = moving();
  model.motion.tracks[2].values = {1, 1, 1, 0, 0, 0};
  const auto vanishing = built(std::move(model), "vanishes");
  const auto gone = [&](double time) {
    LocalPipeline pipeline(*vanishing, {.width = 120, .height = 90, .device = test::device()});
    return pipeline.draw(frame(0, time)).visible.size();
  };
  EXPECT_EQ(gone(0.5), gone(1.5) + 1);
}

TEST(Moving, a_model_without_motion_has_no_poses) {
  const auto still = built(standing(), "stands");
  EXPECT_EQ(still->skeleton().moving, nullptr);
  EXPECT_EQ(FrameView(still->skeleton(), frame(0, 5).state).poses, nullptr);
}

}  // namespace
}  // namespace triptych
