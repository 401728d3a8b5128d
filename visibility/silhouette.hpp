// The outline of a box on the screen, tighter than the rectangle around it.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <span>

namespace triptych {

/// A half-plane of the screen, in normalised device coordinates (−1 to 1, y up): where normal · p + offset
/// ≥ 0. Everywhere by default.
struct HalfPlane {
  glm::vec2 normal{0};
  float offset = 1;
  float at(float x, float y) const { return normal.x * x + normal.y * y + offset; }
};

/// The most points that silhouette() takes.
inline constexpr size_t max_outline_points = 16;

/// Half-planes that hold all the points: for each corner of the rectangle around them the side of their
/// convex hull that cuts the most off there, if any does. They are moved outwards, so that each holds
/// whatever is at most `margin` away from a point, horizontally and vertically. Points in normalised device
/// coordinates.
std::array<HalfPlane, 4> silhouette(std::span<const glm::dvec2> points, const glm::dvec2& margin);

}  // namespace triptych
