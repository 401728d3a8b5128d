// Triangles that cross the near plane or leave the guard band.
#pragma once

#include "raster/window.hpp"

#include <array>
#include <cstddef>
#include <glm/vec4.hpp>

namespace triptych {

/// A convex polygon: a triangle cut by five planes has at most eight corners.
struct ClippedPolygon {
  std::array<WindowVertex, 8> corners;
  size_t count = 0;  ///< 0: nothing is left
};

/// A corner in clip space. `rounded` is what triangles that are not clipped are drawn with: it says on which
/// side of a plane the corner lies, and where, so that neighbours meet. `exact` is the same before it was
/// rounded: points on cut edges are computed from it, since what is far away rounds by more than what is near
/// can bear.
struct ClipCorner {
  glm::vec4 rounded;
  glm::dvec4 exact;
};

/// Sutherland and Hodgman, Reentrant polygon clipping, 1974, in clip space. Where an edge is cut, the point
/// is computed from its inner end, so that both triangles at the edge get the same one.
ClippedPolygon clip_triangle(const std::array<ClipCorner, 3>& corners, const WindowTransform& window);

}  // namespace triptych
