#include "simplify/star_colors.hpp"

#include "simplify/color_charts.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace triptych {

namespace {

glm::dvec3 channels(const VertexColor& color) { return {color[0], color[1], color[2]}; }

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

}  // namespace

void StarColors::read(const ShrinkingMesh& mesh, uint32_t point, std::span<const Spoke> spokes) {
  spokes_ = spokes;
  corners_.clear();
  moved_.assign(spokes.size(), {});
  for (const Spoke& spoke : spokes) {
    const auto& corners = mesh.face(spoke.triangle).corners;
    const CornerColors& colors = mesh.colors(spoke.triangle);
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

/// Of the colours that the fan has at the target the one nearest to `own`, which stays where it has none.
VertexColor StarColors::nearest_at(uint32_t target, const Star::Fan& fan, const VertexColor& own) const {
  VertexColor nearest = own;
  int least = 256;
  for (size_t i = fan.begin; i < fan.end; ++i) {
    if (spokes_[i].from != target && spokes_[i].to != target) continue;
    const VertexColor& color = spokes_[i].from == target ? corners_[i].from : corners_[i].to;
    const int difference = color_difference(color, own);
    if (difference >= least) continue;
    least = difference;
    nearest = color;
  }
  return nearest;
}

double StarColors::change(const Star::Fan& fan, uint32_t target, std::span<const glm::dvec3> from,
                          std::span<const glm::dvec3> to, const glm::dvec3& way,
                          std::span<const double> removed) {
  samples_.clear();
  for (size_t i = fan.begin; i < fan.end; ++i) {
    const Corners& corners = corners_[i];
    moved_[i] = nearest_at(target, fan, corners.point);
    const glm::dvec3 here = channels(corners.point);
    samples_.push_back({glm::dvec3(0), here});
    samples_.push_back({from[i] * 0.5, (here + channels(corners.from)) * 0.5});
    if (i + 1 == fan.end && !fan.closed)
      samples_.push_back({to[i] * 0.5, (here + channels(corners.to)) * 0.5});
  }
  double most = 0;
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
    if (within == fan.end) return 0;  // nothing of the fan is left: its neighbours cover it
    weights = glm::clamp(weights, 0.0, 1.0);
    const double sum = weights.x + weights.y + weights.z;
    if (!(sum > 0)) continue;
    const Corners& corners = corners_[within];
    const glm::dvec3 color = (channels(moved_[within]) * weights.x + channels(corners.from) * weights.y +
                              channels(corners.to) * weights.z) /
                             sum;
    const glm::dvec3 gap = glm::abs(color - sample.color);
    most = std::max({most, gap.x, gap.y, gap.z});
  }
  return distinct(most);
}

}  // namespace triptych
