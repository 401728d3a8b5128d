#include "light/area_sources.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

namespace triptych {

namespace {

/// The first of ascending sums that is above the value.
size_t first_above(std::span<const double> sums, double value) {
  const auto found = std::upper_bound(sums.begin(), sums.end(), value);
  return std::min(static_cast<size_t>(found - sums.begin()), sums.size() - 1);
}

}  // namespace

AreaSources::AreaSources(const LitScene& scene, std::vector<float> luminances, double least)
    : scene_(&scene), least_(least) {
  const LitModel& model = scene.model();
  for (uint32_t t = 0; t < model.triangles.size(); ++t) {
    const double own = static_cast<double>(luminances[t]);
    if (!(own > least)) continue;
    const LitTriangle& triangle = model.triangles[t];
    const double area = glm::length(model.normal(triangle)) / 2;
    if (!(area > 0)) continue;
    if (triangle.instance >= body_of_.size()) body_of_.resize(triangle.instance + 1, no_id);
    uint32_t& body = body_of_[triangle.instance];
    if (body == no_id) {
      body = static_cast<uint32_t>(bodies_.size());
      bodies_.emplace_back();
    }
    Body& to = bodies_[body];
    to.powers.push_back((to.powers.empty() ? 0 : to.power()) + own * area);
    to.triangles.push_back(t);
    for (const LitCorner& corner : triangle.corners) to.box.extend(model.at(corner));
    ++triangles_;
  }
}

std::vector<double> AreaSources::chances(const glm::dvec3& position, const glm::dvec3& normal) const {
  std::vector<double> chances;
  double all = 0;
  for (const Body& body : bodies_) {
    const glm::dvec3 way = (body.box.lo + body.box.hi) * 0.5 - position;
    const double radius = glm::distance(body.box.lo, body.box.hi) / 2, squared = glm::dot(way, way);
    const bool below = glm::dot(way, normal) < -radius;
    const double own = below ? 0 : body.power() / std::max(squared, radius * radius);
    chances.push_back(own);
    all += own;
  }
  if (!(all > 0)) return {};
  for (double& chance : chances) chance /= all;
  return chances;
}

AreaSources::Sample AreaSources::sample(const std::vector<double>& chances, const glm::dvec2& choice,
                                        const glm::dvec2& place) const {
  size_t chosen = 0;
  double left = choice.x;
  while (chosen + 1 < chances.size() && left >= chances[chosen]) left -= chances[chosen++];
  while (chosen > 0 && !(chances[chosen] > 0)) --chosen;  // of rounding
  const Body& body = bodies_[chosen];
  Sample sample;
  sample.triangle = body.triangles[first_above(body.powers, choice.y * body.power())];
  const double root = std::sqrt(place.x);
  sample.u = root * (1 - place.y);
  sample.v = root * place.y;
  const LitModel& model = scene_->model();
  const auto& corners = model.triangles[sample.triangle].corners;
  sample.position = model.at(corners[0]) * (1 - sample.u - sample.v) + model.at(corners[1]) * sample.u +
                    model.at(corners[2]) * sample.v;
  return sample;
}

double AreaSources::density(const std::vector<double>& chances, uint32_t instance, double luminance) const {
  if (instance >= body_of_.size() || body_of_[instance] == no_id || !(luminance > least_)) return 0;
  const uint32_t body = body_of_[instance];
  return chances[body] * luminance / bodies_[body].power();
}

}  // namespace triptych
