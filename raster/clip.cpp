#include "raster/clip.hpp"

#include <algorithm>
#include <cmath>

namespace triptych {

namespace {

using Plane = WindowTransform::Plane;

constexpr size_t max_corners = 8;

struct Polygon {
  std::array<ClipCorner, max_corners> corners;
  size_t count = 0;

  // Rounding may make a polygon that is nearly a line cross more often than a convex one does.
  void add(const ClipCorner& corner) {
    if (count < max_corners) corners[count++] = corner;
  }
};

ClipCorner crossing(const ClipCorner& in, const ClipCorner& out, Plane plane, const WindowTransform& window) {
  const double d_in = window.inside(in.exact, plane), d_out = window.inside(out.exact, plane);
  const double share = std::clamp(d_in / (d_in - d_out), 0.0, 1.0);
  glm::dvec4 point = in.exact + share * (out.exact - in.exact);
  if (plane == Plane::near) {
    // Exactly on the plane. Perspective: z is one number everywhere; orthographic: w is.
    if (in.exact.z == out.exact.z)
      point.w = in.exact.z;
    else
      point.z = in.exact.w;
  }
  return {glm::vec4(point), point};
}

Polygon cut(const Polygon& polygon, Plane plane, const WindowTransform& window) {
  Polygon result;
  for (size_t i = 0; i < polygon.count; ++i) {
    const ClipCorner &here = polygon.corners[i], &next = polygon.corners[(i + 1) % polygon.count];
    const bool here_in = window.inside(here.rounded, plane) >= 0,
               next_in = window.inside(next.rounded, plane) >= 0;
    if (here_in) result.add(here);
    if (here_in != next_in)
      result.add(here_in ? crossing(here, next, plane, window) : crossing(next, here, plane, window));
  }
  return result;
}

}  // namespace

ClippedPolygon clip_triangle(const std::array<ClipCorner, 3>& corners, const WindowTransform& window) {
  Polygon polygon{.corners = {corners[0], corners[1], corners[2]}, .count = 3};
  for (const Plane plane : {Plane::near, Plane::right, Plane::left, Plane::top, Plane::bottom})
    polygon = cut(polygon, plane, window);
  ClippedPolygon result;
  if (polygon.count < 3) return result;
  for (size_t i = 0; i < polygon.count; ++i) {
    glm::vec4 corner = polygon.corners[i].rounded;
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
