// The outline of a box on the screen, tighter than the rectangle around it.
#pragma once

#include <array>
#include <glm/vec2.hpp>

namespace triptych {

/// A half-plane of the screen, in normalised device coordinates (−1 to 1, y up): where normal · p + offset
/// ≥ 0. Everywhere by default.
struct HalfPlane {
  glm::vec2 normal{0};
  float offset = 1;
  float at(float x, float y) const { return normal.x * x + normal.y * y + offset; }
};

/// Which faces of a box face the eye, axis by axis: the one at its low corner, the one at its high corner.
using FacingSides = std::array<std::array<bool, 2>, 3>;

/// Half-planes that hold a box: for each corner of the rectangle around it the edge of its outline that cuts
/// the most off there, if any does. The outline are edges between faces that face the eye and others. The
/// half-planes are moved outwards, so that each holds whatever is at most `margin` away from the box,
/// horizontally and vertically. corners: Box::corner(0) to (7), all before the eye, in normalised device
/// coordinates. terms: how large the terms are that these were summed from, which are rounded.
std::array<HalfPlane, 4> silhouette(const std::array<glm::dvec2, 8>& corners, const FacingSides& facing,
                                    const glm::dvec2& margin, double terms = 1);

}  // namespace triptych
