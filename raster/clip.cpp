#include "raster/clip.hpp"

#include <algorithm>
#include <cmath>

namespace triptych {

namespace {

constexpr size_t max_corners = 8;

struct Polygon {
  std::array<glm::vec4, max_corners> corners;
  size_t count = 0;
};

using Plane = WindowTransform::Plane;

glm::vec4 crossing(const glm::vec4& in, const glm::vec4& out, float d_in, float d_out, Plane plane) {
  const float share = d_in / (d_in - d_out);
  glm::vec4 point = in + share * (out - in);
  if (plane == Plane::near) {
    // Exactly on the plane. Perspective: z is one number everywhere; orthographic: w is.
    if (in.z == out.z)
      point.w = in.z;
    else
      point.z = in.w;
  }
  return point;
}

Polygon cut(const Polygon& polygon, Plane plane, const WindowTransform& window) {
  Polygon result;
  for (size_t i = 0; i < polygon.count; ++i) {
    const glm::vec4 &here = polygon.corners[i], &next = polygon.corners[(i + 1) % polygon.count];
    const float d_here = window.inside(here, plane), d_next = window.inside(next, plane);
    // Rounding may make a polygon that is a line cross more often than a convex one does.
    if (d_here >= 0 && result.count < max_corners) result.corners[result.count++] = here;
    if ((d_here >= 0) != (d_next >= 0) && result.count < max_corners) {
      result.corners[result.count++] = d_here >= 0 ? crossing(here, next, d_here, d_next, plane)
                                                   : crossing(next, here, d_next, d_here, plane);
    }
  }
  return result;
}

}  // namespace

ClippedPolygon clip_triangle(const std::array<glm::vec4, 3>& corners, const WindowTransform& window) {
  Polygon polygon{.corners = {corners[0], corners[1], corners[2]}, .count = 3};
  for (const Plane plane : {Plane::near, Plane::right, Plane::left, Plane::top, Plane::bottom})
    polygon = cut(polygon, plane, window);
  ClippedPolygon result;
  if (polygon.count < 3) return result;
  for (size_t i = 0; i < polygon.count; ++i) {
    glm::vec4 corner = polygon.corners[i];
    if (!(std::isfinite(corner.x) && std::isfinite(corner.y) && corner.w > 0)) return result;
    // Where w nearly cancels out, rounding may leave a corner anywhere.
    const float most_x = 1.5f * window.guard_x() * corner.w, most_y = 1.5f * window.guard_y() * corner.w;
    corner.x = std::clamp(corner.x, -most_x, most_x);
    corner.y = std::clamp(corner.y, -most_y, most_y);
    result.corners[i] = window.apply(corner);
  }
  result.count = polygon.count;
  return result;
}

}  // namespace triptych
