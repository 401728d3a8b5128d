// Light whose amount is known in closed form.
#include "tests/light/rooms.hpp"

#include <gtest/gtest.h>
#include <numbers>

namespace triptych::test {
namespace {

constexpr double pi = std::numbers::pi;

TEST(Gather, of_a_point_light_over_a_plane_it_is_as_its_distance_and_angle_say) {
  Model model = floor_model(16);
  model.lights = {point_light({0.3, 1.5, -0.2}, 100)};
  const LightBake bake(model, as_it_is(), {}, run_points);
  const PointLight light = bake.gather(16, 0, run_points);
  ASSERT_EQ(light.irradiance.size(), 17u * 17);
  for (size_t i = 0; i < light.irradiance.size(); ++i) {
    const glm::dvec3 way = model.lights[0].position - bake.points()[i].position;
    const double r = glm::length(way), expected = 100 * (way.y / r) / (r * r);
    EXPECT_NEAR(light.irradiance[i].g, expected, 1e-3 * expected) << i;
  }
}

TEST(Gather, of_spots_and_directional_lights_as_gltf_has_it) {
  Model model = floor_model(16);
  ModelLight spot = point_light({0, 1, 0}, 100);
  spot.kind = ModelLight::Kind::spot;
  spot.direction = {0, -1, 0};
  spot.inner_cosine = std::cos(0.2);
  spot.outer_cosine = std::cos(0.7);
  ModelLight sun;
  sun.kind = ModelLight::Kind::directional;
  sun.direction = glm::normalize(glm::dvec3(1, -2, 0));
  sun.intensity = {0, 0, 50};
  model.lights = {spot, sun};
  const LightBake bake(model, as_it_is(), {}, run_points);
  const PointLight light = bake.gather(16, 0, run_points);
  for (size_t i = 0; i < light.irradiance.size(); ++i) {
    const glm::dvec3 way = spot.position - bake.points()[i].position;
    const double r = glm::length(way), cosine = way.y / r;
    double share =
        std::clamp((cosine - spot.outer_cosine) / (spot.inner_cosine - spot.outer_cosine), 0.0, 1.0);
    share *= share;
    const double expected = 100 * share * cosine / (r * r);
    EXPECT_NEAR(light.irradiance[i].g, expected, 1e-3 * expected + 1e-2) << i;
    EXPECT_NEAR(light.irradiance[i].b, expected + 50 * 2 / std::sqrt(5.0), 1e-3 * (expected + 45)) << i;
  }
}

TEST(Gather, many_lights_are_sampled_to_the_same_mean) {
  Model model = floor_model(4);
  for (int i = 0; i < 60; ++i) model.lights.push_back(point_light({0.05 * (i - 30), 1 + 0.01 * i, 0}, 5));
  const LightBake bake(model, as_it_is(), {}, run_points);
  const PointLight light = bake.gather(1024, 0, run_points);
  for (size_t i = 0; i < light.irradiance.size(); ++i) {
    double expected = 0;
    for (const ModelLight& own : model.lights) {
      const glm::dvec3 way = own.position - bake.points()[i].position;
      expected += 5 * way.y / std::pow(glm::length(way), 3);
    }
    EXPECT_NEAR(light.irradiance[i].r, expected, 1e-2 * expected) << i;
  }
}

TEST(Gather, in_a_furnace_bounces_add_up_to_the_geometric_series) {
  // Every direction has the radiance L; each bounce sends the share ρ of it on: E = π L (1 + ρ + … + ρⁿ).
  constexpr double reflectance = 0.5;
  const Model model = inside_of_box(3, grey(static_cast<float>(reflectance), 0.1f));
  LightOptions options = as_it_is();
  for (const uint32_t bounces : {0u, 1u, 6u}) {
    options.bounces = bounces;
    const LightBake bake(model, options, {}, run_points);
    const PointLight light = bake.gather(256, 0, run_points);
    double series = 0;
    for (uint32_t i = 0; i <= bounces; ++i) series += std::pow(reflectance, i);
    const double expected = pi * 0.1 * emission_luminance * series;
    double sum = 0;
    for (const glm::vec3& own : light.irradiance) {
      EXPECT_NEAR(own.g, expected, 0.1 * expected) << bounces;
      sum += own.g;
    }
    EXPECT_NEAR(sum / static_cast<double>(light.irradiance.size()), expected, 0.01 * expected) << bounces;
  }
}

TEST(Gather, of_a_disc_above_a_point_it_is_as_its_form_factor_says) {
  // E = π L R² / (R² + h²) straight below the middle.
  constexpr double radius = 0.5, height = 1;
  Model model = floor_model(2);
  Mesh disc;
  constexpr uint32_t sides = 128;
  disc.positions.push_back({0, height, 0});
  for (uint32_t i = 0; i < sides; ++i)
    disc.positions.push_back(
        {radius * std::cos(2 * pi * i / sides), height, radius * std::sin(2 * pi * i / sides)});
  for (uint32_t i = 0; i < sides; ++i) disc.triangles.push_back({{0, 1 + i, 1 + (i + 1) % sides}, 1});
  model.meshes.push_back(disc);
  model.materials.push_back(grey(0, 1));
  model.instances.push_back({1, Affine(1)});
  LightOptions options = as_it_is();
  options.bounces = 0;
  const LightBake bake(model, options, {}, run_points);
  const PointLight light = bake.gather(1024, 0, run_points);
  for (size_t i = 0; i < light.irradiance.size(); ++i) {
    if (glm::length(bake.points()[i].position) > 1e-2 || bake.points()[i].normal.y < 0.9) continue;
    const double expected = pi * emission_luminance * radius * radius / (radius * radius + height * height);
    EXPECT_NEAR(light.irradiance[i].g, expected, 0.02 * expected);
    return;
  }
  FAIL() << "no point lies below the middle";
}

TEST(Gather, glass_lets_through_what_it_does_not_cover_and_walls_nothing) {
  for (const float alpha : {0.25f, 1.0f}) {
    Model model = floor_model(4);
    Mesh pane;
    add_rectangle(pane, {-3, 0.5, 3}, {6, 0, 0}, {0, 0, -6}, 1, 1, 1);
    model.meshes.push_back(pane);
    model.materials.push_back(grey(0.5f));
    model.materials[1].base_color.a = alpha;
    model.instances.push_back({1, Affine(1)});
    model.lights = {point_light({0, 1, 0}, 100)};
    LightOptions options = as_it_is();
    options.bounces = 0;
    const LightBake bake(model, options, {}, run_points);
    const PointLight light = bake.gather(16, 0, run_points);
    for (size_t i = 0; i < light.irradiance.size(); ++i) {
      const LightPoint& point = bake.points()[i];
      if (point.position.y > 0.1) continue;
      const double r = glm::length(glm::dvec3(0, 1, 0) - point.position);
      EXPECT_NEAR(light.irradiance[i].g, (1 - alpha) * 100 / (r * r * r), 0.1) << i;
    }
  }
}

TEST(Gather, beside_a_long_wall_half_of_the_surroundings_is_open) {
  Mesh ground, wall;  // both far beyond the reach
  add_rectangle(ground, {0, 0, 2}, {4, 0, 0}, {0, 0, -4}, 8, 8, 0);
  Model model = model_of(ground, {grey(0.5f)});
  add_rectangle(wall, {0, 0, 2}, {0, 4, 0}, {0, 0, -4}, 1, 1, 0);
  model.meshes.push_back(wall);
  model.instances.push_back({1, Affine(1)});
  LightOptions options = as_it_is();
  options.bake = false;
  options.ambient = true;
  options.reach = 0.1;
  const LightBake bake(model, options, {}, run_points);
  const PointLight light = bake.gather(1024, 0, run_points);
  size_t near = 0, far = 0;
  for (size_t i = 0; i < light.openness.size(); ++i) {
    const LightPoint& point = bake.points()[i];
    if (point.normal.y < 0.9 || std::abs(point.position.z) > 1) continue;
    if (std::abs(point.position.x) > 1) {
      EXPECT_EQ(light.openness[i], 1);
      ++far;
    } else if (std::abs(point.position.x) < 0.01) {
      EXPECT_NEAR(light.openness[i], 0.5, 0.03);
      ++near;
    }
  }
  EXPECT_GT(near, 0u);
  EXPECT_GT(far, 0u);
}

TEST(Gather, noise_falls_with_samples) {
  Model model = inside_of_box(4, grey(0.7f));
  model.lights = {point_light({0.2, 0.6, 0.1}, 100)};
  const LightBake bake(model, as_it_is(), {}, run_points);
  const PointLight reference = bake.gather(2048, 1, run_points);
  const auto error = [&](uint32_t samples) {
    const PointLight light = bake.gather(samples, 0, run_points);
    double sum = 0;
    for (size_t i = 0; i < light.irradiance.size(); ++i)
      sum += std::pow(light.irradiance[i].g - reference.irradiance[i].g, 2);
    return std::sqrt(sum);
  };
  EXPECT_LT(error(256), 0.5 * error(16));
}

}  // namespace
}  // namespace triptych::test
