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

uint32_t rays_to_bodies(uint32_t samples) { return std::max(samples / 4, 8u); }

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

std::vector<double> Gatherer::chances(const GatherPlace& place) const {
  std::vector<double> chances;
  double all = 0;
  for (const EmissiveBody& body : emitters_.bodies) {
    const glm::dvec3 way = body.middle - place.position;
    const double squared = glm::dot(way, way);
    // None of it is above the horizon.
    const bool below = body.triangles.empty() || glm::dot(way, place.normal) < -body.radius;
    const double own = below ? 0 : body.power / std::max(squared, body.radius * body.radius);
    chances.push_back(own);
    all += own;
  }
  if (!(all > 0)) return {};
  for (double& chance : chances) chance /= all;
  return chances;
}

DirectLight Gatherer::direct(const GatherPlace& place, uint32_t samples, bool looks_around) const {
  DirectLight light;
  const uint32_t to_bodies = rays_to_bodies(samples);
  if (options_.bake) light.irradiance = from_lights(place, to_bodies);
  const std::vector<double> chances =
      options_.bake && !emitters_.bodies.empty() ? this->chances(place) : std::vector<double>();
  // Both kinds of rays find emissive surfaces; each counts by how likely it was to.
  const auto density = [&](const EmissiveBody& body, double chance, double squared, double cosine_there) {
    return cosine_there > 0 ? chance * squared / (body.area() * cosine_there) : 0;
  };
  if (!chances.empty()) {
    std::vector<double> sums;
    double all = 0;
    for (const double chance : chances) sums.push_back(all += chance);
    const SamplePoints points(place.seed ^ 0xb0d1e5u), choices(place.seed ^ 0xc401ceu);
    const LitModel& model = light_scene_.model();
    for (uint32_t i = 0; i < to_bodies; ++i) {
      const glm::dvec2 choice = choices[i];
      const size_t chosen = first_above(sums, (i + choice.x) / to_bodies * all);
      const EmissiveBody& body = emitters_.bodies[chosen];
      if (!(chances[chosen] > 0)) continue;
      const uint32_t triangle = body.triangles[first_above(body.areas, choice.y * body.area())];
      const LitTriangle& own = model.triangles[triangle];
      const glm::dvec2 u = points[i];
      const double root = std::sqrt(u.x);
      const glm::dvec3 at = model.at(own.corners[0]) * (1 - root) +
                            model.at(own.corners[1]) * (root * (1 - u.y)) +
                            model.at(own.corners[2]) * (root * u.y);
      const glm::dvec3 way = at - place.position;
      const double squared = glm::dot(way, way), length = std::sqrt(squared);
      if (!(length > 0)) continue;
      const double cosine = glm::dot(way, place.normal) / length;
      const double cosine_there = std::abs(glm::dot(way, glm::normalize(model.normal(own)))) / length;
      if (!(cosine > 0) || !(cosine_there > 0)) continue;
      const double by_body = density(body, chances[chosen], squared, cosine_there), by_cosine = cosine / pi;
      const double passed = scene_.passes(place.position, at);
      if (passed > 0)
        light.irradiance += emitters_.radiance(light_scene_, triangle) *
                            (passed * cosine / (to_bodies * by_body + samples * by_cosine));
    }
  }
  if (chances.empty() && !looks_around) return light;
  const Frame3 frame(place.normal);
  const SamplePoints points(place.seed);
  const double reach = options_.reach * scene_.model().diagonal;
  uint32_t near = 0, backs = 0;
  for (uint32_t i = 0; i < samples; ++i) {
    const glm::dvec3 direction = cosine_direction(frame, points[i]);
    const double cosine = glm::dot(direction, place.normal);
    bool first = true;
    scene_.trace(place.position, direction, [&](const LitScene::Hit& hit) {
      if (first) {
        near += hit.distance < reach ? 1 : 0;
        backs += hit.back ? 1 : 0;
        first = false;
      }
      if (!options_.bake || emitters_.bodies.empty()) return;
      const glm::dvec3 radiance = emitters_.radiance(scene_, hit.triangle);
      if (radiance == glm::dvec3(0)) return;
      const LitTriangle& own = scene_.model().triangles[hit.triangle];
      const uint32_t body = emitters_.body_of[own.instance];
      const double cosine_there = std::abs(glm::dot(direction, glm::normalize(scene_.model().normal(own))));
      const double by_body =
          body == no_id || chances.empty()
              ? 0
              : density(emitters_.bodies[body], chances[body], hit.distance * hit.distance, cosine_there);
      const double by_cosine = cosine / pi;
      light.irradiance += radiance * (hit.share * cosine / (to_bodies * by_body + samples * by_cosine));
    });
  }
  light.openness = 1 - static_cast<double>(near) / samples;
  light.backs = static_cast<double>(backs) / samples;
  return light;
}

glm::dvec3 Gatherer::bounced(const GatherPlace& place, uint32_t samples,
                             std::span<const glm::vec3> points) const {
  const Frame3 frame(place.normal);
  const SamplePoints directions(place.seed);
  glm::dvec3 sum(0);
  for (uint32_t i = 0; i < samples; ++i) {
    scene_.trace(place.position, cosine_direction(frame, directions[i]), [&](const LitScene::Hit& hit) {
      const auto& corners = scene_.model().triangles[hit.triangle].corners;
      const glm::dvec3 irradiance = glm::dvec3(points[corners[0].point]) * (1 - hit.u - hit.v) +
                                    glm::dvec3(points[corners[1].point]) * hit.u +
                                    glm::dvec3(points[corners[2].point]) * hit.v;
      sum += reflectance_of(scene_, hit.triangle) * irradiance * hit.share;
    });
  }
  return sum / static_cast<double>(samples);
}

}  // namespace triptych
