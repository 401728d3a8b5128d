#include "simplify/convex_polygon.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace triptych {

glm::dvec3 middle_of(const ConvexPolygon& polygon) {
  glm::dvec3 sum{0};
  for (const glm::dvec3& corner : polygon) sum += corner;
  return sum / static_cast<double>(polygon.size());
}

ConvexPolygon cut(ConvexPolygon& polygon, const glm::dvec3& normal, double limit, double narrow) {
  std::array<double, ConvexPolygon::max_corners + 2> beyond;
  double furthest = -1, deepest = -1;
  for (size_t i = 0; i < polygon.size(); ++i) {
    beyond[i] = glm::dot(normal, polygon[i]) - limit;
    furthest = std::max(furthest, beyond[i]);
    deepest = std::max(deepest, -beyond[i]);
  }
  if (furthest <= narrow) return {};
  ConvexPolygon inside, outside;
  if (deepest <= narrow) {
    std::swap(polygon, outside);
    return outside;
  }
  for (size_t i = 0; i < polygon.size(); ++i) {
    const size_t next = (i + 1) % polygon.size();
    if (beyond[i] <= 0) inside.push_back(polygon[i]);
    if (beyond[i] >= 0) outside.push_back(polygon[i]);
    if ((beyond[i] < 0 && beyond[next] > 0) || (beyond[i] > 0 && beyond[next] < 0)) {
      const glm::dvec3 crossing =
          polygon[i] + (polygon[next] - polygon[i]) * (beyond[i] / (beyond[i] - beyond[next]));
      inside.push_back(crossing);
      outside.push_back(crossing);
    }
  }
  polygon = inside;
  return outside;
}

}  // namespace triptych
