// Pictures of several samples a pixel, and with edges: as exact as others, and what they are for.
#include "lod/cut.hpp"
#include "nodes/pack_device.hpp"
#include "preprocess/build.hpp"
#include "scene/sample_places.hpp"
#include "tests/render/rig.hpp"
#include "tests/support/awkward_meshes.hpp"
#include "tests/support/scenes.hpp"
#include "visibility/edge_rule.hpp"
#include "visibility/shading.hpp"

#include <cmath>
#include <fmt/core.h>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <memory>
#include <unistd.h>

namespace triptych {
namespace {

class SampledPictures : public testing::TestWithParam<std::string> {};

TEST_P(SampledPictures, equal_the_un_culled_ones_in_every_pixel) {
  constexpr int width = 120, height = 91;
  const Pack& pack = scenes::pack(GetParam());
  const std::vector<View> views = scenes::path(pack.skeleton(), width, height);
  size_t first = 0;
  for (const uint32_t samples : {4u, 8u, 16u}) {
    Rig rig(pack, width, height);
    for (size_t i = first++; i < views.size(); i += 4) {
      const FrameState state{views[i], scenes::pixel_error(i), samples, i % 2 == 0};
      EXPECT_EQ(rig.draw({static_cast<uint32_t>(i), state}).differing_pixels, 0u)
          << "frame " << i << ", " << samples << " samples";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, SampledPictures, testing::ValuesIn(scenes::names()),
                         [](const auto& parameter) { return parameter.param; });

/// A pack of one mesh; no file of it is left.
std::unique_ptr<Pack> pack_of(Mesh mesh) {
  Model model;
  model.materials.push_back({glm::vec4(0.1, 0.1, 0.1, 1)});
  for (Triangle& triangle : mesh.triangles) triangle.material = 0;
  model.meshes.push_back(std::move(mesh));
  model.instances.push_back({0, Affine(1)});
  const auto file =
      std::filesystem::path(testing::TempDir()) / fmt::format("triptych_samples_{}.tpk", ::getpid());
  build_pack(model, {}, file);
  auto pack = std::make_unique<Pack>(file);
  std::filesystem::remove(file);  // the pack keeps it open
  return pack;
}

View before(const glm::dvec3& eye, int width, int height, double shift = 0) {
  View view{.camera = {.eye = eye, .target = eye - glm::dvec3(0, 0, 1), .near = 0.1},
            .width = width,
            .height = height};
  set_field_of_view(view.camera, 60, static_cast<double>(width) / height);
  const double across = shift / view.focal_x();
  view.camera.left += across;
  view.camera.right += across;
  return view;
}

std::vector<uint8_t> picture(LocalPipeline& pipeline, const FrameState& state) {
  pipeline.draw({0, state});
  return pipeline.target().read_colors();
}

LocalPipeline pipeline_of(const Pack& pack, int width, int height) {
  return LocalPipeline(pack, {.width = width, .height = height, .device = test::device()});
}

TEST(Samples, lie_where_they_are_documented) {
  // Sixteen times as large, and moved by half of a pixel of its own where places are even, a picture has a
  // pixel centre at each sample.
  constexpr int side = 40, finer = 16;
  const Pack& pack = scenes::pack("room");
  LocalPipeline large = pipeline_of(pack, finer * side, finer * side),
                pipeline = pipeline_of(pack, side, side);
  const auto from_a_corner = [](int pixels, double moved) {
    View view = before({1, 1, 1.6}, pixels, pixels);
    Camera& camera = view.camera;
    camera.target = {20, 9, 1};
    camera.up = {0, 0, 1};
    for (double* const edge : {&camera.left, &camera.right, &camera.bottom, &camera.top})
      *edge += moved / view.focal_x();
    return view;
  };
  for (const uint32_t samples : {4u, 8u, 16u}) {
    const View view = from_a_corner(side, 0);
    const auto fine = picture(large, {from_a_corner(finer * side, samples == 16 ? 0 : -0.5), 0}),
               sampled = picture(pipeline, {view, 0, samples});
    const auto error = [&](int sign_x, int sign_y) {
      const auto along = [](int pixel, int offset) {
        const int at = pixel * finer + finer / 2 + static_cast<int>(std::floor(offset / 2.0));
        return std::clamp(at, 0, finer * side - 1);
      };
      double sum = 0;
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
          double mean = 0;
          for (const SamplePlace& place : sample_places(samples)) {
            const int column = along(x, sign_x * place.x), row = along(y, sign_y * place.y);
            mean +=
                fine[static_cast<size_t>(4 * (row * finer * side + column))] / static_cast<double>(samples);
          }
          sum += std::abs(sampled[static_cast<size_t>(4 * (y * side + x))] - mean);
        }
      }
      return sum / (side * side);
    };
    EXPECT_LT(error(1, 1), 0.5) << samples << " samples";  // of 255, rounding included
    EXPECT_LT(error(1, 1), 0.5 * std::min(error(-1, 1), error(1, -1))) << samples << " samples";
  }
}

/// Spread of how dark a picture is as a whole, while the camera's frustum moves over a pixel.
double spread_of_cover(LocalPipeline& pipeline, uint32_t samples) {
  constexpr int side = 64, steps = 25;
  double sum = 0, squares = 0;
  for (int step = 0; step < steps; ++step) {
    const auto colors =
        picture(pipeline, {before({0, 0, 6}, side, side, static_cast<double>(step) / steps), 0, samples});
    double cover = 0;
    for (size_t i = 0; i < colors.size(); i += 4) cover += background_bytes[0] - colors[i];
    sum += cover / steps;
    squares += cover * cover / steps;
  }
  EXPECT_GT(sum, 0);
  return std::sqrt(std::max(0.0, squares - sum * sum)) / sum;
}

TEST(Samples, let_a_thing_that_is_thinner_than_a_pixel_fade_where_it_would_flicker) {
  // Upright, three tenths of a pixel wide.
  const auto pack = pack_of(awkward::box({-0.01624, -2, -0.01}, {0.01624, 2, 0.01}));
  LocalPipeline pipeline = pipeline_of(*pack, 64, 64);
  const double of_one = spread_of_cover(pipeline, 1);
  EXPECT_GT(of_one, 1) << "it is there or not";
  for (const uint32_t samples : {4u, 8u, 16u})
    EXPECT_LT(spread_of_cover(pipeline, samples), of_one / 3) << samples << " samples";
}

TEST(Samples, of_a_picture_of_one_change_nothing_of_it_but_outlines) {
  const Pack& pack = scenes::pack("room");
  constexpr int side = 96;
  LocalPipeline pipeline = pipeline_of(pack, side, side);
  const View view = scenes::path(pack.skeleton(), side, side)[3];
  const auto one = picture(pipeline, {view, 1}), many = picture(pipeline, {view, 1, 8});
  const size_t different = test::differing_pixels(one, many);
  EXPECT_GT(different, 0u);
  EXPECT_LT(different, size_t{side * side / 2});
  EXPECT_EQ(test::differing_pixels(one, picture(pipeline, {view, 1})), 0u) << "back to one";
}

class PicturesWithEdges : public testing::TestWithParam<std::string> {};

TEST_P(PicturesWithEdges, differ_in_the_colours_of_edges_alone) {
  constexpr int width = 120, height = 91;
  const Pack& pack = scenes::pack(GetParam());
  LocalPipeline pipeline = pipeline_of(pack, width, height),
                items(pack,
                      {.width = width, .height = height, .device = test::device(), .item_buffer = true});
  const std::vector<View> views = scenes::path(pack.skeleton(), width, height);
  size_t edges = 0, pixels = 0;
  for (size_t i = 1; i < views.size(); i += 6) {
    pipeline.forget();
    items.forget();
    const VisibleSet visible = pipeline.draw({0, {views[i], 1}}).visible;
    const auto plain = pipeline.target().read_colors();
    items.draw({0, {views[i], 1}});
    const auto owners = items.target().read_items();
    pipeline.forget();
    items.forget();
    EXPECT_EQ(pipeline.draw({0, {views[i], 1, 1, true}}).visible, visible);
    const auto edged = pipeline.target().read_colors();
    items.draw({0, {views[i], 1, 1, true}});
    EXPECT_EQ(items.target().read_items(), owners);
    for (size_t at = 0; at < plain.size(); at += 4, ++pixels) {
      if (std::equal(&plain[at], &plain[at] + 4, &edged[at])) continue;
      ++edges;
      EXPECT_TRUE(std::equal(edge_bytes.begin(), edge_bytes.end(), &edged[at]));
      EXPECT_NE(owners[at / 4], 0u) << "an edge where nothing is";
    }
  }
  EXPECT_GT(edges, 0u);
  EXPECT_LT(edges, pixels / 2);
}

INSTANTIATE_TEST_SUITE_P(Scenes, PicturesWithEdges, testing::Values("room", "instances", "painted"),
                         [](const auto& parameter) { return parameter.param; });

TEST(PictureWithEdges, shows_a_box_as_its_outline_and_its_creases_a_pixel_wide) {
  const auto pack = pack_of(awkward::box({-1, -1, -1}, {1, 1, 1}));
  constexpr int side = 100;
  View view = before({4, 3, 5}, side, side);
  view.camera.target = {0, 0, 0};
  LocalPipeline pipeline = pipeline_of(*pack, side, side);
  const auto is_edge = [&](const std::vector<uint8_t>& colors, int x, int y) {
    return std::equal(edge_bytes.begin(), edge_bytes.end(), &colors[static_cast<size_t>(4 * (y * side + x))]);
  };
  const auto colors = picture(pipeline, {view, 1, 1, true});
  // Along the middle row: the outline, a crease, the outline; nothing else.
  int lines = 0, widest = 0, run = 0;
  for (int x = 0; x < side; ++x) {
    run = is_edge(colors, x, side / 2) ? run + 1 : 0;
    lines += run == 1;
    widest = std::max(widest, run);
  }
  EXPECT_EQ(lines, 3);
  EXPECT_LE(widest, 2) << "where a crease goes up by a pixel, it is two wide";
  // With samples lines are as dark together, and no pixel need be all edge.
  const auto darkness = [&](const std::vector<uint8_t>& of) {
    double sum = 0;
    for (size_t i = 0; i < of.size(); i += 4) sum += of[i];
    return sum;
  };
  const double plain = darkness(picture(pipeline, {view, 1})), one = plain - darkness(colors);
  for (const uint32_t samples : {4u, 16u}) {
    const double many = darkness(picture(pipeline, {view, 1, samples})) -
                        darkness(picture(pipeline, {view, 1, samples, true}));
    EXPECT_NEAR(many / one, 1, 0.15) << samples << " samples";
  }
}

}  // namespace
}  // namespace triptych
