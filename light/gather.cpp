#include "light/gather.hpp"

#include "light/sampling.hpp"
#include "scene/linear_light.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace triptych {

namespace {

constexpr double pi = std::numbers::pi;
constexpr uint32_t most_single_lights = 32;

uint32_t rays_to_sources(uint32_t samples) { return std::max(samples / 4, 8u); }

/// The first of ascending sums that is above the value.
size_t first_above(std::span<const double> sums, double value) {
  const auto found = std::upper_bound(sums.begin(), sums.end(), value);
  return std::min(static_cast<size_t>(found - sums.begin()), sums.size() - 1);
}

}  // namespace

GatherPlace gather_place(const LightPoint& point, bool back, double clearance, uint64_t seed) {
  const glm::dvec3 normal = back ? -point.normal : point.normal;
  return {point.position + normal * clearance, normal, seed};
}

glm::dvec3 reflectance_of(const LitScene& scene, uint32_t triangle) {
  constexpr double most = 0.9;
  const LitTriangle& own = scene.model().triangles[triangle];
  glm::dvec3 color = scene.surface(triangle).reflectance;
  if (std::ranges::all_of(own.corners, [](const LitCorner& corner) { return is_colored(corner.color); })) {
    const LinearLight& light = LinearLight::table();
    glm::dvec3 mean(0);
    for (const LitCorner& corner : own.corners)
      for (int k = 0; k < 3; ++k)
        mean[k] += light.of(corner.color[static_cast<size_t>(k)]) / (3.0 * LinearLight::most);
    color = own.material == 0 ? mean : color * mean;
  }
  return glm::min(color, glm::dvec3(most));
}

glm::dvec3 Gatherer::unshadowed(const GatherPlace& place, const ModelLight& light) const {
  if (light.kind == ModelLight::Kind::directional)
    return light.intensity * std::max(0.0, -glm::dot(light.direction, place.normal));
  const glm::dvec3 way = light.position - place.position;
  const double distance = glm::length(way);
  if (!(distance > 0)) return glm::dvec3(0);
  const double cosine = glm::dot(way, place.normal) / distance;
  if (!(cosine > 0) || (light.range > 0 && distance > light.range)) return glm::dvec3(0);
  double share = 1;
  if (light.kind == ModelLight::Kind::spot) {
    // As KHR_lights_punctual has it: linear in the cosine between the cones, squared.
    const double along = -glm::dot(way, light.direction) / distance;
    share = std::clamp((along - light.outer_cosine) / std::max(light.inner_cosine - light.outer_cosine, 1e-3),
                       0.0, 1.0);
    share *= share;
  }
  return light.intensity * (share * cosine / (distance * distance));
}

double Gatherer::passes(const GatherPlace& place, const ModelLight& light) const {
  return light.kind == ModelLight::Kind::directional
             ? scene_.passes_from_sky(place.position, -light.direction)
             : scene_.passes(place.position, light.position);
}

glm::dvec3 Gatherer::from_lights(const GatherPlace& place, uint32_t samples) const {
  glm::dvec3 sum(0);
  if (emitters_.lights.size() <= most_single_lights) {
    for (const ModelLight& light : emitters_.lights) {
      const glm::dvec3 own = unshadowed(place, light);
      if (own != glm::dvec3(0)) sum += own * passes(place, light);
    }
    return sum;
  }
  std::vector<double> sums;
  double all = 0;
  for (const ModelLight& light : emitters_.lights) sums.push_back(all += luminance(unshadowed(place, light)));
  if (!(all > 0)) return sum;
  const double first = SamplePoints(place.seed ^ 0x51u)[0].x;
  for (uint32_t i = 0; i < samples; ++i) {
    const size_t chosen = first_above(sums, (i + first) / samples * all);
    const double chance = (sums[chosen] - (chosen > 0 ? sums[chosen - 1] : 0)) / all;
    if (!(chance > 0)) continue;
    const ModelLight& light = emitters_.lights[chosen];
    sum += unshadowed(place, light) * (passes(place, light) / (chance * samples));
  }
  return sum;
}

DirectLight Gatherer::from_surfaces(const GatherPlace& place, uint32_t samples, const AreaSources& sources,
                                    const LitScene& scene_of_sources, const SentBy& sent) const {
  DirectLight light;
  const std::vector<double> chances =
      sources.empty() ? std::vector<double>() : sources.chances(place.position, place.normal);
  const uint32_t to_sources = chances.empty() ? 0 : rays_to_sources(samples);
  // Both kinds of rays find the sources; each counts by how likely it was to. Of a direction:
  const auto likely = [&](const LitScene& scene, uint32_t triangle, double luminance, double squared,
                          const glm::dvec3& direction) {
    if (to_sources == 0) return 0.0;
    const LitTriangle& own = scene.model().triangles[triangle];
    const double density = sources.density(chances, own.instance, luminance);
    if (!(density > 0)) return 0.0;
    const double cosine = std::abs(glm::dot(direction, glm::normalize(scene.model().normal(own))));
    return cosine > 0 ? to_sources * density * squared / cosine : 0.0;
  };
  const SamplePoints places(place.seed ^ 0xb0d1e5u), choices(place.seed ^ 0xc401ceu);
  for (uint32_t i = 0; i < to_sources; ++i) {
    const glm::dvec2 choice = choices[i];
    const AreaSources::Sample at =
        sources.sample(chances, {(i + choice.x) / to_sources, choice.y}, places[i]);
    const glm::dvec3 way = at.position - place.position;
    const double squared = glm::dot(way, way), length = std::sqrt(squared);
    if (!(length > 0)) continue;
    const double cosine = glm::dot(way, place.normal) / length;
    if (!(cosine > 0)) continue;
    const Sent own = sent(scene_of_sources, at.triangle, at.u, at.v);
    const double by_source = likely(scene_of_sources, at.triangle, own.luminance, squared, way / length);
    if (!(by_source > 0)) continue;
    const double passed = scene_.passes(place.position, at.position);
    if (passed > 0)
      light.irradiance += own.radiance * (passed * cosine / (by_source + samples * cosine / pi));
  }
  const Frame3 frame(place.normal);
  const SamplePoints directions(place.seed);
  const double reach = options_.reach * scene_.model().diagonal;
  uint32_t near = 0, backs = 0;
  for (uint32_t i = 0; i < samples; ++i) {
    const glm::dvec3 direction = cosine_direction(frame, directions[i]);
    const double cosine = glm::dot(direction, place.normal);
    bool first = true;
    scene_.trace(place.position, direction, [&](const LitScene::Hit& hit) {
      if (first) {
        near += hit.distance < reach ? 1 : 0;
        backs += hit.back ? 1 : 0;
        first = false;
      }
      const Sent own = sent(scene_, hit.triangle, hit.u, hit.v);
      if (own.radiance == glm::dvec3(0) || !(cosine > 0)) return;
      const double by_source =
          likely(scene_, hit.triangle, own.luminance, hit.distance * hit.distance, direction);
      light.irradiance += own.radiance * (hit.share * cosine / (by_source + samples * cosine / pi));
    });
  }
  light.openness = 1 - static_cast<double>(near) / samples;
  light.backs = static_cast<double>(backs) / samples;
  return light;
}

DirectLight Gatherer::direct(const GatherPlace& place, uint32_t samples, bool looks_around) const {
  DirectLight light;
  const bool finds_surfaces = options_.bake && !emitters_.surfaces.empty();
  if (finds_surfaces || looks_around) {
    light = from_surfaces(place, samples, options_.bake ? emitters_.surfaces : AreaSources(), light_scene_,
                          [&](const LitScene& scene, uint32_t triangle, double, double) -> Sent {
                            if (!finds_surfaces) return {glm::dvec3(0), 0};
                            const glm::dvec3 own = emitters_.radiance(scene, triangle);
                            return {own, luminance(own)};
                          });
  }
  if (options_.bake) light.irradiance += from_lights(place, rays_to_sources(samples));
  return light;
}

namespace {

glm::dvec3 irradiance_at(const LitTriangle& triangle, std::span<const glm::vec3> points, double u, double v) {
  const auto& corners = triangle.corners;
  return glm::dvec3(points[corners[0].point]) * (1 - u - v) + glm::dvec3(points[corners[1].point]) * u +
         glm::dvec3(points[corners[2].point]) * v;
}

/// Of the whole triangle.
double reflected_luminance(const LitScene& scene, uint32_t triangle, std::span<const glm::vec3> points) {
  const glm::dvec3 mean = irradiance_at(scene.model().triangles[triangle], points, 1.0 / 3, 1.0 / 3);
  return static_cast<double>(static_cast<float>(luminance(reflectance_of(scene, triangle) * mean) / pi));
}

}  // namespace

glm::dvec3 Gatherer::bounced(const GatherPlace& place, uint32_t samples, std::span<const glm::vec3> points,
                             const AreaSources& bright) const {
  return from_surfaces(place, samples, bright, scene_,
                       [&](const LitScene& scene, uint32_t triangle, double u, double v) -> Sent {
                         const LitTriangle& own = scene.model().triangles[triangle];
                         return {reflectance_of(scene, triangle) * irradiance_at(own, points, u, v) / pi,
                                 bright.empty() ? 0 : reflected_luminance(scene, triangle, points)};
                       })
      .irradiance;
}

AreaSources bright_surfaces(const LitScene& scene, std::span<const glm::vec3> points) {
  constexpr double brighter = 4;  // than the mean
  const LitModel& model = scene.model();
  std::vector<float> luminances;
  double sum = 0, area = 0;
  for (uint32_t t = 0; t < model.triangles.size(); ++t) {
    luminances.push_back(static_cast<float>(reflected_luminance(scene, t, points)));
    const double own = glm::length(model.normal(model.triangles[t])) / 2;
    // What is in the dark, as the outsides of walls, says nothing of the rest.
    if (!(luminances.back() > 0)) continue;
    sum += static_cast<double>(luminances.back()) * own;
    area += own;
  }
  if (!(area > 0)) return {};
  return AreaSources(scene, std::move(luminances), brighter * sum / area);
}

}  // namespace triptych
