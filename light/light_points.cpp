#include "light/light_points.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace triptych {

namespace {

glm::dvec3 unit(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : glm::dvec3(0);
}

/// At the corner, in radians.
double angle_at(const LitModel& model, const LitTriangle& triangle, size_t k) {
  const glm::dvec3& here = model.at(triangle.corners[k]);
  const glm::dvec3 a = unit(model.at(triangle.corners[(k + 1) % 3]) - here),
                   b = unit(model.at(triangle.corners[(k + 2) % 3]) - here);
  return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

/// Corners at one place whose normals are close to each other.
struct Corners {
  glm::dvec3 first;  ///< normal
  glm::dvec3 normals{0}, middles{0};
  double weight = 0;
  uint32_t instance = 0;
};

LightPoint point_of(const Corners& corners, const glm::dvec3& place, double clearance) {
  LightPoint point{place, unit(corners.normals), corners.instance};
  if (point.normal == glm::dvec3(0)) point.normal = corners.first;
  if (!(corners.weight > 0)) return point;
  const glm::dvec3 way = corners.middles / corners.weight - place;
  const double length = glm::length(way);
  // Off surfaces that end here, so that rays start on the right side of them.
  constexpr double share = 1e-3, most = 0.25;
  if (length > 0) point.position += way * std::min(std::max(share, 2 * clearance / length), most);
  return point;
}

}  // namespace

glm::dvec3 corner_normal(const LitModel& model, const LitTriangle& triangle, size_t corner) {
  const VertexNormal& own = triangle.corners[corner].normal;
  return unit(has_normal(own) ? direction_of(own) : model.normal(triangle));
}

std::vector<LightPoint> make_points(LitModel& model, double clearance) {
  std::vector<uint64_t> first(model.places.size() + 1, 0);
  for (const LitTriangle& triangle : model.triangles)
    for (const LitCorner& corner : triangle.corners) ++first[corner.place + 1];
  for (size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  std::vector<uint64_t> corners(3 * model.triangles.size());  // 3 · triangle + corner, by place
  std::vector<uint64_t> next(first.begin(), first.end() - 1);
  for (uint64_t t = 0; t < model.triangles.size(); ++t)
    for (uint64_t k = 0; k < 3; ++k) corners[next[model.triangles[t].corners[k].place]++] = 3 * t + k;
  std::vector<LightPoint> points;
  std::vector<Corners> groups;
  for (size_t place = 0; place < model.places.size(); ++place) {
    groups.clear();
    for (uint64_t i = first[place]; i < first[place + 1]; ++i) {
      LitTriangle& triangle = model.triangles[corners[i] / 3];
      const size_t k = corners[i] % 3;
      const glm::dvec3 normal = corner_normal(model, triangle, k);
      auto group = std::ranges::find_if(
          groups, [&](const Corners& own) { return glm::dot(own.first, normal) > crease_cosine; });
      if (group == groups.end()) {
        groups.push_back({.first = normal, .instance = triangle.instance});
        group = groups.end() - 1;
      }
      const double weight = angle_at(model, triangle, k);
      const auto& at = triangle.corners;
      group->normals += normal * weight;
      group->middles += (model.at(at[0]) + model.at(at[1]) + model.at(at[2])) * (weight / 3);
      group->weight += weight;
      triangle.corners[k].point =
          static_cast<uint32_t>(points.size() + static_cast<size_t>(group - groups.begin()));
    }
    for (const Corners& group : groups) points.push_back(point_of(group, model.places[place], clearance));
  }
  return points;
}

}  // namespace triptych
