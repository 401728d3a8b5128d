#include "simplify/star_colors.hpp"

#include "simplify/color_charts.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace triptych {

namespace {

glm::dvec3 channels(const SurfaceCorner& corner) {
  return {corner.color[0], corner.color[1], corner.color[2]};
}

/// In the steps of light_difference().
glm::dvec4 lights(const SurfaceCorner& corner) {
  return {2.0 * corner.light[0], 2.0 * corner.light[1], 2.0 * corner.light[2], corner.light[3]};
}

glm::dvec2 place_of(const SurfaceCorner& corner) { return {corner.coordinates.u, corner.coordinates.v}; }

/// From 0 for colours that look the same to 1 for distinct ones.
double distinct(double difference) {
  return std::clamp((difference - equal_colors) / (distinct_colors - equal_colors), 0.0, 1.0);
}

/// Weights of the corners 0, u and v of a triangle at the point of its plane nearest to q; negative outside.
glm::dvec3 weights_at(const glm::dvec3& u, const glm::dvec3& v, const glm::dvec3& q) {
  const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v);
  const double area = uu * vv - uv * uv;
  if (!(area > 0)) return glm::dvec3(-1);
  const double qu = glm::dot(q, u), qv = glm::dot(q, v);
  const double b = (qu * vv - qv * uv) / area, c = (qv * uu - qu * uv) / area;
  return {1 - b - c, b, c};
}

/// How long on the surface a difference of coordinates is. u, v: two edges of a triangle; along_u, along_v:
/// the difference along them. Infinite where the texture does not vary over the triangle as much.
double length_on_surface(const glm::dvec3& u, const glm::dvec3& v, const glm::dvec2& along_u,
                         const glm::dvec2& along_v, const glm::dvec2& difference) {
  constexpr double rounding = 4;  // of coordinates, in their units
  if (std::max(std::abs(difference.x), std::abs(difference.y)) <= rounding) return 0;
  const double area = along_u.x * along_v.y - along_u.y * along_v.x;
  const double a = (difference.x * along_v.y - difference.y * along_v.x) / area,
               b = (difference.y * along_u.x - difference.x * along_u.y) / area;
  const double length = glm::length(u * a + v * b);
  return std::isfinite(length) ? length : std::numeric_limits<double>::infinity();
}

}  // namespace

void StarColors::read(const ShrinkingMesh& mesh, uint32_t point, std::span<const Spoke> spokes) {
  spokes_ = spokes;
  corners_.clear();
  moved_.assign(spokes.size(), {});
  for (const Spoke& spoke : spokes) {
    const auto& corners = mesh.face(spoke.triangle).corners;
    const SurfaceCorners& colors = mesh.colors(spoke.triangle);
    const auto color_of = [&](uint32_t corner) {
      return colors[corners[0] == corner ? 0 : corners[1] == corner ? 1 : 2];
    };
    corners_.push_back({color_of(point), color_of(spoke.from), color_of(spoke.to)});
  }
}

double StarColors::difference(uint32_t neighbour) const {
  int most = 0;
  for (size_t i = 0; i < spokes_.size(); ++i) {
    if (spokes_[i].from == neighbour)
      most = std::max(most, color_difference(corners_[i].point, corners_[i].from));
    if (spokes_[i].to == neighbour)
      most = std::max(most, color_difference(corners_[i].point, corners_[i].to));
  }
  return distinct(most);
}

/// Of what the fan has at the target what is nearest to `own`, which stays where it has nothing.
SurfaceCorner StarColors::nearest_at(uint32_t target, const Star::Fan& fan, const SurfaceCorner& own) const {
  SurfaceCorner nearest = own;
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = fan.begin; i < fan.end; ++i) {
    if (spokes_[i].from != target && spokes_[i].to != target) continue;
    const SurfaceCorner& corner = spokes_[i].from == target ? corners_[i].from : corners_[i].to;
    const double difference = color_difference(corner, own) +
                              glm::distance(place_of(corner), place_of(own)) / TextureCoordinates::unit;
    if (difference >= least) continue;
    least = difference;
    nearest = corner;
  }
  return nearest;
}

StarColors::Change StarColors::change(const Star::Fan& fan, uint32_t target, std::span<const glm::dvec3> from,
                                      std::span<const glm::dvec3> to, const glm::dvec3& way,
                                      std::span<const double> removed) {
  samples_.clear();
  for (size_t i = fan.begin; i < fan.end; ++i) {
    const Corners& corners = corners_[i];
    moved_[i] = nearest_at(target, fan, corners.point);
    const auto add_halfway = [&](const glm::dvec3& place, const SurfaceCorner& end) {
      samples_.push_back({i, place * 0.5, (channels(corners.point) + channels(end)) * 0.5,
                          (lights(corners.point) + lights(end)) * 0.5,
                          (place_of(corners.point) + place_of(end)) * 0.5});
    };
    samples_.push_back(
        {i, glm::dvec3(0), channels(corners.point), lights(corners.point), place_of(corners.point)});
    add_halfway(from[i], corners.from);
    if (i + 1 == fan.end && !fan.closed) add_halfway(to[i], corners.to);
  }
  const bool textured = is_on_texture(corners_[fan.begin].point.coordinates);
  double most = 0, off = 0;
  for (const Sample& sample : samples_) {
    // Seen from the plane of the triangle that holds it, or of the one that it is the least outside of.
    double best = -std::numeric_limits<double>::infinity();
    glm::dvec3 weights(0);
    size_t within = fan.end;
    for (size_t i = fan.begin; i < fan.end; ++i) {
      if (removed[i] < 0) continue;
      const glm::dvec3 own = weights_at(from[i] - way, to[i] - way, sample.place - way);
      const double least = std::min({own.x, own.y, own.z});
      if (within != fan.end && !(least > best)) continue;
      best = least;
      weights = own;
      within = i;
    }
    if (within == fan.end) return {};  // nothing of the fan is left: its neighbours cover it
    weights = glm::clamp(weights, 0.0, 1.0);
    const double sum = weights.x + weights.y + weights.z;
    if (!(sum > 0)) continue;
    const auto mixed = [&](const auto& at_target, const auto& at_from, const auto& at_to) {
      return (at_target * weights.x + at_from * weights.y + at_to * weights.z) / sum;
    };
    const Corners& corners = corners_[within];
    const glm::dvec3 color = mixed(channels(moved_[within]), channels(corners.from), channels(corners.to));
    const glm::dvec3 gap = glm::abs(color - sample.color);
    const glm::dvec4 light = mixed(lights(moved_[within]), lights(corners.from), lights(corners.to));
    const glm::dvec4 light_gap = glm::abs(light - sample.light);
    most = std::max({most, gap.x, gap.y, gap.z, light_gap.x, light_gap.y, light_gap.z, light_gap.w});
    if (!textured) continue;
    const Corners& before = corners_[sample.spoke];
    const glm::dvec2 at = place_of(before.point),
                     now = mixed(place_of(moved_[within]), place_of(corners.from), place_of(corners.to));
    off = std::max(off, length_on_surface(from[sample.spoke], to[sample.spoke], place_of(before.from) - at,
                                          place_of(before.to) - at, now - sample.coordinates));
  }
  return {distinct(most), std::isfinite(off) ? off : glm::length(way)};
}

}  // namespace triptych
