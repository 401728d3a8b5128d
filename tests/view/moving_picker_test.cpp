// Clicks on what moves: it is where it is in the frame that is shown.
#include "lod/cut.hpp"
#include "preprocess/build.hpp"
#include "tests/support/awkward_meshes.hpp"
#include "view/picker.hpp"

#include <cmath>
#include <fmt/core.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>
#include <unistd.h>

namespace triptych {
namespace {

/// A ball that flies from x = -3 to 3 in two seconds before a wall at y = 2.
std::unique_ptr<Pack> ball() {
  Model model;
  model.materials = {{glm::vec4(1, 0, 0, 1)}};
  model.meshes = {awkward::box({-5, 2, -5}, {5, 2.2, 5}), awkward::sphere(12, 0.5)};
  model.instances = {{0, Affine(1)}};
  model.motion.tracks = {{Interpolation::linear, 3, 2, {0, 2}, {-3, 0, 0, 3, 0, 0}}};
  model.motion.joints = {{.translation_track = 0}};
  model.groups = {{{{1, Affine(1)}}, {}}};
  model.group_instances = {{0, transform_at(model.motion, 0, 0)}};
  model.group_instances[0].joint = 0;
  const auto file = std::filesystem::path(testing::TempDir()) / fmt::format("picked_{}.tpk", ::getpid());
  build_pack(std::move(model), {}, file);
  auto pack = std::make_unique<Pack>(file);
  std::filesystem::remove(file);
  return pack;
}

TEST(MovingPicker, meets_what_moves_where_it_is_in_the_frame) {
  const std::unique_ptr<Pack> pack = ball();
  const Skeleton& skeleton = pack->skeleton();
  Picker picker(*pack);
  FrameState state{
      {.camera = {.eye = {0, -8, 0}, .target = {0, 0, 0}, .up = {0, 0, 1}}, .width = 200, .height = 200}, 0};
  set_field_of_view(state.view.camera, 60, 1);
  state.view.camera.near = 0.01;
  const double pixels_a_metre = 100 / (8 * std::tan(glm::radians(30.0)));
  for (const double time : {0.3, 1.0, 1.7, 2.3}) {
    state.time = time;
    const double x = -3 + 3 * std::fmod(time, 2);
    const std::vector<DrawableId> shown = select_cut(FrameView(skeleton, state)).drawables;
    for (const double aside : {0.0, 1.0}) {
      const auto picked = picker.at(state, shown, 100 + pixels_a_metre * (x + aside), 100);
      ASSERT_TRUE(picked) << time;
      const double from_ball = glm::distance(picked->point, glm::dvec3(x, 0, 0));
      if (aside == 0) {
        EXPECT_NEAR(from_ball, 0.5, 0.02) << time;
      } else {
        EXPECT_NEAR(picked->point.y, 2, 0.01) << time;
      }
    }
  }
  state.effects = Effects::none();
  const auto frozen = select_cut(FrameView(skeleton, state)).drawables;
  const auto picked = picker.at(state, frozen, 100 - 3 * pixels_a_metre, 100);
  ASSERT_TRUE(picked);
  EXPECT_LT(glm::distance(picked->point, glm::dvec3(-3, 0, 0)), 0.52);
}

}  // namespace
}  // namespace triptych
