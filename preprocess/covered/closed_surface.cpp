#include "preprocess/covered/closed_surface.hpp"

#include "simplify/key_hash.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <tsl/robin_map.h>

namespace triptych {

Outside outside_of(const Surface& surface) {
  tsl::robin_map<std::array<uint32_t, 2>, int, KeyHash, KeyEqual> balance;
  for (const Triangle& triangle : surface.triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t from = triangle.vertices[k], to = triangle.vertices[(k + 1) % 3];
      balance[{std::min(from, to), std::max(from, to)}] += from < to ? 1 : -1;
    }
  }
  if (std::any_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second != 0; }))
    return Outside::none;
  DisjointSets sets = connected_points(surface);
  std::vector<double> volumes(surface.points.size(), 0);  // six times those of pieces, at their roots
  for (const Triangle& triangle : surface.triangles) {
    const uint32_t root = sets.root(triangle.vertices[0]);
    // From a point near by, so that nothing cancels.
    const auto at = [&](size_t k) {
      return glm::dvec3(surface.points[triangle.vertices[k]] - surface.points[root]);
    };
    volumes[root] += glm::dot(at(0), glm::cross(at(1), at(2)));
  }
  bool front = true, back = true;
  for (const Triangle& triangle : surface.triangles) {
    const double volume = volumes[sets.root(triangle.vertices[0])];
    front = front && volume > 0;
    back = back && volume < 0;
  }
  return front ? Outside::front : back ? Outside::back : Outside::none;
}

}  // namespace triptych
