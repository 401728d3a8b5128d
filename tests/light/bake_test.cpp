#include "light/bake.hpp"

#include "base/error.hpp"
#include "base/threads.hpp"
#include "tests/light/rooms.hpp"

#include <gtest/gtest.h>

namespace triptych::test {
namespace {

Model lit_room() {
  Model model = inside_of_box(2, grey(0.6f));
  model.lights = {point_light({0.2, 0.6, 0.1}, 100)};
  return model;
}

LightOptions quick() {
  LightOptions options;
  options.bake = true;
  options.samples = 16;
  options.bounces = 1;
  options.shortest_edge = 1.0 / 32;
  return options;
}

TEST(Bake, is_the_same_for_any_number_of_threads) {
  const auto baked = [&](unsigned threads) {
    set_thread_count(threads);
    LightReport report;
    const Model model = bake_light(lit_room(), quick(), {}, run_points, report);
    set_thread_count(0);
    return model.meshes.at(0);
  };
  const Mesh one = baked(1), several = baked(3);
  EXPECT_EQ(one.positions, several.positions);
  EXPECT_EQ(one.triangles, several.triangles);
  EXPECT_EQ(one.light, several.light);
}

TEST(Bake, without_emitters_the_model_is_what_it_was) {
  Model model = lit_room();
  model.lights.clear();
  LightReport report;
  const Model same = bake_light(model, quick(), {}, run_points, report);
  EXPECT_FALSE(report.baked || report.ambient);
  EXPECT_EQ(report.points, 0u);
  EXPECT_TRUE(same.meshes.at(0).light.empty());
  EXPECT_EQ(same.meshes.at(0).positions, model.meshes.at(0).positions);
}

TEST(Bake, what_moves_goes_on_moving_and_has_no_light) {
  Model model = lit_room();
  Mesh board;
  add_rectangle(board, {0, 0, 0}, {0.2, 0, 0}, {0, 0, -0.2}, 1, 1, 0);
  model.meshes.push_back(board);
  model.groups = {{.instances = {{1, Affine(1)}}, .groups = {}}};
  Affine moved(1);
  moved[3] = {0, -0.5, 0};
  model.group_instances = {{0, Affine(1)}, {0, moved}};
  model.group_instances[1].joint = 0;
  model.motion.joints = {{.translation = {0, -0.5, 0}}};
  LightReport report;
  const Model lit = bake_light(model, quick(), {}, run_points, report);
  ASSERT_TRUE(report.baked);
  EXPECT_EQ(lit.motion, model.motion);
  ASSERT_EQ(lit.group_instances.size(), 1u);
  EXPECT_EQ(lit.group_instances[0].joint, 0u);
  const Mesh& moving = lit.meshes.at(lit.groups.at(lit.group_instances[0].group).instances.at(0).mesh);
  EXPECT_EQ(moving.positions, board.positions);
  EXPECT_TRUE(moving.light.empty());
  ASSERT_EQ(lit.instances.size(), 2u) << "the room and the board that rests";
  for (const Instance& instance : lit.instances) EXPECT_FALSE(lit.meshes.at(instance.mesh).light.empty());
}

TEST(Bake, placements_that_are_lit_differently_get_meshes_of_their_own) {
  Model model = lit_room();
  Mesh board;
  add_rectangle(board, {0, 0, 0}, {0.2, 0, 0}, {0, 0, -0.2}, 1, 1, 0);
  board.colors.assign(4, VertexColor{200, 100, 50, 255});
  model.meshes.push_back(board);
  Affine mirrored(1), moved(1);
  mirrored[0][0] = -1;
  moved[3] = {0.5, -0.9, 0.5};
  model.instances.push_back({1, mirrored});
  model.instances.push_back({1, moved});
  LightReport report;
  const Model lit = bake_light(model, quick(), {}, run_points, report);
  ASSERT_EQ(lit.meshes.size(), 3u);
  EXPECT_EQ(report.unshared_triangles, 2u);
  for (const Mesh& mesh : lit.meshes) {
    EXPECT_EQ(mesh.light.size(), mesh.positions.size());
    for (const VertexLight& light : mesh.light) EXPECT_TRUE(has_light(light));
  }
  EXPECT_EQ(lit.meshes[1].colors.size(), lit.meshes[1].positions.size());
  // The nearer one is brighter; and a mirrored one still looks up.
  EXPECT_GT(lit.meshes[1].light[0][1], lit.meshes[2].light[0][1]);
  const Mesh& mesh = lit.meshes[1];
  const auto& corners = mesh.triangles[0].vertices;
  EXPECT_GT(glm::cross(mesh.positions[corners[1]] - mesh.positions[corners[0]],
                       mesh.positions[corners[2]] - mesh.positions[corners[0]])
                .y,
            0);
}

TEST(Bake, surfaces_of_luminaires_give_their_flux) {
  Model model = inside_of_box(2, grey(0.5f));
  Mesh lamp;
  add_rectangle(lamp, {-0.2, 0.9, -0.2}, {0.4, 0, 0}, {0, 0, 0.4}, 1, 1, 0);
  model.meshes.push_back(lamp);
  SourceObjects& objects = model.source_objects;
  objects.objects.push_back({.type = objects.texts.add("IfcLightFixture")});
  model.instances.push_back({1, Affine(1), 0});
  LightOptions options = as_it_is();
  options.bounces = 0;
  const LightBake bake(model, options, {}, run_points);
  EXPECT_EQ(bake.report().luminaires, 1u);
  // Straight below, far from it: I = Φ/π, E = I/h².
  const PointLight light = bake.gather(256, 0, run_points);
  for (size_t i = 0; i < light.irradiance.size(); ++i) {
    const LightPoint& point = bake.points()[i];
    if (glm::length(point.position - glm::dvec3(0, -1, 0)) > 0.01) continue;
    const double expected = luminaire_flux / std::numbers::pi / (1.9 * 1.9);
    EXPECT_NEAR(light.irradiance[i].g, expected, 0.05 * expected);
  }
}

TEST(Bake, what_does_not_fit_into_memory_is_an_error_that_says_what_to_do) {
  LightOptions options = quick();
  options.memory = 1000;
  LightReport report;
  try {
    bake_light(lit_room(), options, {}, run_points, report);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("--memory"), std::string::npos) << error.what();
  }
}

TEST(Bake, light_is_stored_to_a_fiftieth_of_white_and_below) {
  for (int i = 0; i <= 1000; ++i) {
    const float irradiance = 0.004f * static_cast<float>(i);
    EXPECT_NEAR(irradiance_of(irradiance_byte(irradiance)), irradiance,
                0.0079 * std::sqrt(irradiance) + 1e-4);
    EXPECT_NEAR(openness_of(openness_byte(0.001f * static_cast<float>(i))), 0.001f * static_cast<float>(i),
                0.002);
  }
  EXPECT_TRUE(has_light({0, 0, 0, openness_byte(0)}));
}

}  // namespace
}  // namespace triptych::test
