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

/// Sutherland and Hodgman, Reentrant polygon clipping, 1974, in clip space. Where an edge is cut, the point
/// is computed from its inner end, so that both triangles at the edge get the same one.
ClippedPolygon clip_triangle(const std::array<glm::vec4, 3>& corners, const WindowTransform& window);

}  // namespace triptych
