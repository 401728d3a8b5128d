#include "visibility/silhouette.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace triptych {

namespace {

/// How far evaluating a half-plane in floats may be off, as a share of the sum of its terms; the graphics
/// card's own rounding included.
constexpr double half_plane_rounding = 0x1p-20;

/// Positive where the way from a by b to c turns left.
double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The hull of few points, without an allocation: a box has eight corners.
struct Hull {
  std::array<glm::dvec2, 2 * max_outline_points> points;
  size_t count = 0;

  void add(const glm::dvec2& point, size_t least) {
    while (count >= least + 2 && turn(points[count - 2], points[count - 1], point) <= 0) --count;
    points[count++] = point;
  }
};

/// Counter-clockwise (Andrew, Another efficient algorithm for convex hulls in two dimensions, 1979).
Hull convex_hull(std::span<const glm::dvec2> points) {
  std::array<glm::dvec2, max_outline_points> sorted;
  const auto end = std::copy(points.begin(), points.end(), sorted.begin());
  std::sort(sorted.begin(), end,
            [](const glm::dvec2& a, const glm::dvec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  Hull hull;
  for (size_t i = 0; i < points.size(); ++i) hull.add(sorted[i], 0);
  const size_t lower = hull.count - 1;
  for (size_t i = points.size() - 1; i-- > 0;) hull.add(sorted[i], lower);
  --hull.count;  // the first one again
  return hull;
}

}  // namespace

std::array<HalfPlane, 4> silhouette(std::span<const glm::dvec2> points, const glm::dvec2& margin) {
  std::array<HalfPlane, 4> sides;
  assert(points.size() <= max_outline_points);
  if (points.size() < 3) return sides;
  glm::dvec2 lo = points[0], hi = points[0];
  for (const glm::dvec2& point : points) {
    lo = {std::min(lo.x, point.x), std::min(lo.y, point.y)};
    hi = {std::max(hi.x, point.x), std::max(hi.y, point.y)};
  }
  const Hull outline = convex_hull(points);
  const std::span<const glm::dvec2> hull(outline.points.data(), outline.count);
  std::array<double, 4> max_cut{};  // twice the area cut off at each corner
  for (size_t i = 0; i < hull.size(); ++i) {
    const glm::dvec2 from = hull[i], to = hull[(i + 1) % hull.size()];
    const double length = std::abs(to.x - from.x) + std::abs(to.y - from.y);
    const glm::dvec2 normal = glm::dvec2(from.y - to.y, to.x - from.x) / length;
    // Along the rectangle's sides there is nothing to cut.
    if (!(std::abs(normal.x) > 1e-6 && std::abs(normal.y) > 1e-6)) continue;
    const double offset = -(normal.x * from.x + normal.y * from.y) + std::abs(normal.x) * margin.x +
                          std::abs(normal.y) * margin.y;
    const bool right = normal.x < 0, top = normal.y < 0;  // the corner that is furthest outside
    const double outside = -(normal.x * (right ? hi.x : lo.x) + normal.y * (top ? hi.y : lo.y) + offset);
    const double cut = outside > 0 ? outside * outside / std::abs(normal.x * normal.y) : 0;
    const size_t corner = (right ? 1u : 0u) + (top ? 2u : 0u);
    if (!(cut > max_cut[corner])) continue;
    max_cut[corner] = cut;
    const double rounding = half_plane_rounding * (1 + std::abs(offset));
    sides[corner] = {glm::vec2(normal), static_cast<float>(offset + rounding)};
  }
  return sides;
}

}  // namespace triptych
