// What frames are measured against must be honest: the same triangles and the same picture, without culling.
#include "measure/primary_rays.hpp"
#include "nodes/local_pipeline.hpp"
#include "render/context.hpp"
#include "render/flat_model_pass.hpp"
#include "scene/finest_boxes.hpp"
#include "tests/support/scenes.hpp"
#include "visibility/shading.hpp"

#include <algorithm>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace triptych {
namespace {

constexpr int width = 150, height = 101;  // no multiple of a packet

/// The share of pixels that differ by more than rounding does in some channel.
double different_share(const std::vector<uint8_t>& one, const std::vector<uint8_t>& other) {
  EXPECT_EQ(one.size(), other.size());
  size_t different = 0;
  for (size_t i = 0; i < one.size(); i += 4) {
    int largest = 0;
    for (size_t channel = 0; channel < 3; ++channel)
      largest = std::max(largest, std::abs(int{one[i + channel]} - int{other[i + channel]}));
    different += largest > 2;
  }
  return static_cast<double>(different) / (static_cast<double>(one.size()) / 4);
}

class FlatModelPictures : public testing::TestWithParam<std::string> {};

TEST_P(FlatModelPictures, of_one_draw_and_of_rays_are_those_of_the_device_at_full_detail) {
  const auto context = make_context(ContextKind::egl);
  const Pack& pack = scenes::pack(GetParam());
  const FlatModel model = flatten(pack);
  const FlatModelSize size = flat_model_size(pack.skeleton());
  EXPECT_EQ(model.vertices.size(), size.vertices);
  EXPECT_EQ(model.triangle_count(), size.triangles);
  LocalPipeline pipeline(pack, {.width = width, .height = height, .cull = StrategyKind::none});
  const auto pass = make_gl_flat_model_pass(model, width, height);
  const auto rays = PrimaryRays::build(model);
  ASSERT_TRUE(rays);
  double by_draw = 0, by_rays = 0, between_frames = 0;
  struct {
    double by_draw = 0, by_rays = 0, of_one_sample = 0;
  } sampled;
  std::vector<uint8_t> last;
  const std::vector<View> views = scenes::random_views(pack.skeleton(), width, height, 12, 5);
  for (size_t i = 0; i < views.size(); ++i) {
    const FrameRequest plain{static_cast<uint32_t>(i), {views[i], 0}};
    const FrameRequest frame{plain.number, {views[i], 0, i % 2 == 0 ? 1u : 4u}};
    pipeline.draw(plain);
    const std::vector<uint8_t> of_one_sample = pipeline.target().read_colors();
    const FrameRecord& record = pipeline.draw(frame);
    EXPECT_EQ(record.drawn_triangles, size.triangles);
    const std::vector<uint8_t> truth = pipeline.target().read_colors();
    pass->draw(FrameView(pack.skeleton(), frame.state));
    rays->draw(views[i], {}, frame.state.samples);
    by_draw += different_share(truth, pass->read_colors());
    by_rays += different_share(truth, rays->colors());
    if (frame.state.samples > 1) {
      sampled.by_draw += different_share(truth, pass->read_colors());
      sampled.by_rays += different_share(truth, rays->colors());
      sampled.of_one_sample += different_share(truth, of_one_sample);
    }
    if (!last.empty()) between_frames += different_share(truth, last);
    last = truth;
  }
  const auto frames = static_cast<double>(views.size());
  RecordProperty("by_draw", std::to_string(by_draw / frames));
  RecordProperty("by_rays", std::to_string(by_rays / frames));
  EXPECT_LT(by_draw / frames, 0.01);
  EXPECT_LT(by_rays / frames, 0.02);
  EXPECT_GT(between_frames / frames, 0.2) << "pictures that are all alike prove nothing";
  // Nearer to pictures of as many samples than those of one are.
  EXPECT_LT(sampled.by_draw, sampled.of_one_sample / 2);
  EXPECT_LT(sampled.by_rays, sampled.of_one_sample / 2);
}

INSTANTIATE_TEST_SUITE_P(Scenes, FlatModelPictures, testing::Values("room", "instances", "storeys"),
                         [](const auto& parameter) { return parameter.param; });

/// Of boxes without thickness, which have no cut surfaces.
TEST(FlatModel, of_what_is_cut_and_hidden_is_what_the_device_draws) {
  const auto context = make_context(ContextKind::egl);
  const Pack& pack = scenes::pack_with_objects("flat");
  const PackObjects objects = pack.read_objects();
  ObjectSet every_second;
  for (SourceObjectId id = 0; id < objects.source().objects.size(); id += 2) every_second.push_back(id);
  const Hiding hiding = hide(pack.skeleton(), objects, every_second, "test");
  const FlatModel whole = flatten(pack), model = flatten(pack, hiding.objects.get());
  const FlatModelSize size = flat_model_size(pack.skeleton(), hiding.objects.get());
  EXPECT_EQ(model.vertices.size(), size.vertices);
  EXPECT_EQ(model.triangle_count(), size.triangles);
  EXPECT_LT(model.triangle_count(), whole.triangle_count());
  LocalPipeline pipeline(pack, {.width = width, .height = height, .cull = StrategyKind::none});
  const auto pass = make_gl_flat_model_pass(model, width, height);
  const auto rays = PrimaryRays::build(model);
  ASSERT_TRUE(rays);
  const Box box = model_box(pack.skeleton());
  const std::vector<View> views = scenes::random_views(pack.skeleton(), width, height, 12, 5);
  double by_draw = 0, by_rays = 0, of_the_cut = 0;
  for (size_t i = 0; i < views.size(); ++i) {
    FrameRequest frame{static_cast<uint32_t>(i), {views[i], 0}};
    frame.state.hiding = hiding;
    pipeline.draw(frame);
    const std::vector<uint8_t> uncut = pipeline.target().read_colors();
    const glm::dvec3 normal = glm::normalize(glm::dvec3(i % 3 == 0, 0.3, i % 2 == 0 ? 1 : -1));
    frame.state.section.add_plane({normal, glm::dot(normal, center(box))}, "test");
    if (i % 4 == 0) frame.state.section.set_box({box.lo, center(box) + (box.hi - box.lo) * 0.3}, "test");
    pipeline.draw(frame);
    const std::vector<uint8_t> truth = pipeline.target().read_colors();
    pass->draw(FrameView(pack.skeleton(), frame.state));
    rays->draw(views[i], frame.state.section);
    by_draw += different_share(truth, pass->read_colors());
    by_rays += different_share(truth, rays->colors());
    of_the_cut += different_share(truth, uncut);
  }
  const auto frames = static_cast<double>(views.size());
  EXPECT_LT(by_draw / frames, 0.01);
  EXPECT_LT(by_rays / frames, 0.02);
  EXPECT_GT(of_the_cut / frames, 0.1) << "a section that cuts nothing proves nothing";
}

TEST(PrimaryRays, a_tree_that_does_not_fit_is_not_built) {
  const FlatModel model = flatten(scenes::pack("room"));
  EXPECT_EQ(PrimaryRays::build(model, 1000), nullptr);
  const auto rays = PrimaryRays::build(model);
  ASSERT_TRUE(rays);
  EXPECT_GT(rays->memory_bytes(), model.triangle_count());
}

TEST(PrimaryRays, that_embree_would_refuse_see_nothing) {
  const Pack& pack = scenes::pack("room");
  const FlatModel model = flatten(pack);
  const auto rays = PrimaryRays::build(model);
  ASSERT_TRUE(rays);
  View view = scenes::random_views(pack.skeleton(), 21, 13, 1, 5)[0];
  const glm::dvec3 eye = view.camera.eye;
  for (const double far : {1e20, 1e30, 1e40, 1e200}) {
    view.camera.eye = eye + glm::dvec3(far, 0, 0);
    rays->draw(view);
    for (size_t i = 0; i < rays->colors().size(); ++i) ASSERT_EQ(rays->colors()[i], background_bytes[i % 4]);
  }
  view.camera.eye = eye;
  set_orthographic_height(view.camera, 1e30, 1);
  rays->draw(view);
  EXPECT_EQ(rays->colors().size(), size_t{4} * 21 * 13);
}

}  // namespace
}  // namespace triptych
