#include "scene/motion_tracks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace triptych {

namespace {

enum class Part { in_tangent, value, out_tangent };

glm::dvec4 stored(const MotionTrack& track, size_t key, Part part = Part::value) {
  const bool cubic = track.interpolation == Interpolation::cubic_spline;
  const size_t at = (cubic ? 3 * key + static_cast<size_t>(part) : key) * track.components;
  const double* const values = track.values.data() + at;
  return {values[0], values[1], values[2], track.components == 4 ? values[3] : 0};
}

bool turns(const MotionTrack& track) { return track.components == 4; }

glm::dvec4 unit(const glm::dvec4& quaternion) {
  const double length = std::sqrt(glm::dot(quaternion, quaternion));
  return length > 0 ? quaternion / length : glm::dvec4(0, 0, 0, 1);
}

/// Of two of length 1, that nearest to a of the two that stand for b's rotation.
glm::dvec4 towards(const glm::dvec4& a, const glm::dvec4& b) { return glm::dot(a, b) < 0 ? -b : b; }

/// At even speed from a to b, by halving the way: no sines, which differ from library to library. After 16
/// times the way is so short that a straight line is off by less than doubles are.
glm::dvec4 slerp(glm::dvec4 a, glm::dvec4 b, double share) {
  b = towards(a, b);
  for (int halving = 0; halving < 16; ++halving) {
    const glm::dvec4 middle = unit(a + b);
    share *= 2;
    if (share < 1) {
      b = middle;
    } else {
      a = middle;
      share -= 1;
    }
  }
  return unit(a * (1 - share) + b * share);
}

/// The control points of a cubic segment as a Bézier curve, within whose hull it stays.
using Curve = std::array<glm::dvec4, 4>;

Curve curve_from(const MotionTrack& track, size_t key) {
  const double third = (track.times[key + 1] - track.times[key]) / 3;
  const glm::dvec4 first = stored(track, key), last = stored(track, key + 1);
  return {first, first + third * stored(track, key, Part::out_tangent),
          last - third * stored(track, key + 1, Part::in_tangent), last};
}

glm::dvec4 on_curve(const Curve& curve, double share) {
  const double rest = 1 - share;
  return rest * rest * rest * curve[0] + 3 * rest * rest * share * curve[1] +
         3 * rest * share * share * curve[2] + share * share * share * curve[3];
}

std::array<Curve, 2> halves(const Curve& c) {
  const glm::dvec4 a = (c[0] + c[1]) * 0.5, b = (c[1] + c[2]) * 0.5, d = (c[2] + c[3]) * 0.5;
  const glm::dvec4 e = (a + b) * 0.5, f = (b + d) * 0.5, middle = (e + f) * 0.5;
  return {Curve{c[0], a, e, middle}, Curve{middle, f, d, c[3]}};
}

/// Balls of this radius move a point by two hundredths of its distance from the axis, at most.
constexpr double small_radius = 0.01;
constexpr int max_halvings = 8;
constexpr double rounding = 1e-9;

void add_arc(const glm::dvec4& a, const glm::dvec4& b, int depth, std::vector<QuaternionBall>& balls) {
  const glm::dvec4 middle = unit(a + b);
  const double radius = std::max(glm::distance(a, middle), glm::distance(b, middle));
  if (radius <= small_radius || depth == max_halvings) {
    balls.push_back({middle, radius + rounding});
    return;
  }
  add_arc(a, middle, depth + 1, balls);
  add_arc(middle, b, depth + 1, balls);
}

/// What has length 1 on the curve's way from the origin.
void add_curve(const Curve& curve, int depth, std::vector<QuaternionBall>& balls) {
  const glm::dvec4 middle = (curve[0] + 3.0 * curve[1] + 3.0 * curve[2] + curve[3]) / 8.0;
  double spread = 0;
  for (const glm::dvec4& point : curve) spread = std::max(spread, glm::distance(point, middle));
  const double length = glm::length(middle);
  // Directions of points within `spread` of the middle: |p/|p| − m/|m|| ≤ 2 spread / |m|.
  const double radius = spread < length ? 2 * spread / length : 2;
  if (radius <= small_radius || depth == max_halvings) {
    balls.push_back({unit(middle), std::min(radius + rounding, 2.0)});
    return;
  }
  for (const Curve& half : halves(curve)) add_curve(half, depth + 1, balls);
}

}  // namespace

glm::dvec4 value_at(const MotionTrack& track, double time) {
  double now = 0;
  if (track.length > 0) now = time - std::floor(time / track.length) * track.length;
  const auto above = std::ranges::upper_bound(track.times, now);
  const auto next = static_cast<size_t>(above - track.times.begin());
  const auto as_value = [&](const glm::dvec4& value) { return turns(track) ? unit(value) : value; };
  if (next == 0) return as_value(stored(track, 0));
  const size_t key = next - 1;
  if (next == track.times.size() || track.interpolation == Interpolation::step)
    return as_value(stored(track, key));
  const double share = (now - track.times[key]) / (track.times[next] - track.times[key]);
  if (track.interpolation == Interpolation::cubic_spline)
    return as_value(on_curve(curve_from(track, key), share));
  const glm::dvec4 first = stored(track, key), last = stored(track, next);
  return turns(track) ? slerp(unit(first), unit(last), share) : first * (1 - share) + last * share;
}

Box values_box(const MotionTrack& track) {
  Box box;
  for (size_t key = 0; key < track.times.size(); ++key) {
    box.extend(glm::dvec3(stored(track, key)));
    if (track.interpolation != Interpolation::cubic_spline || key + 1 == track.times.size()) continue;
    for (const glm::dvec4& point : curve_from(track, key)) box.extend(glm::dvec3(point));
  }
  return box;
}

std::vector<QuaternionBall> quaternion_balls(const MotionTrack& track) {
  std::vector<QuaternionBall> balls;
  for (size_t key = 0; key < track.times.size(); ++key) {
    const glm::dvec4 here = unit(stored(track, key));
    balls.push_back({here, rounding});
    if (key + 1 == track.times.size() || track.interpolation == Interpolation::step) continue;
    if (track.interpolation == Interpolation::cubic_spline) {
      add_curve(curve_from(track, key), 0, balls);
    } else {
      add_arc(here, towards(here, unit(stored(track, key + 1))), 0, balls);
    }
  }
  return balls;
}

}  // namespace triptych
