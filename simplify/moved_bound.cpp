#include "simplify/moved_bound.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace triptych {

double moved_bound(double bound, const Surface& level, std::span<const glm::ivec3> before,
                   std::span<const double> errors) {
  const bool known = errors.size() == level.triangles.size();
  double moved = 0, largest = bound;
  for (size_t i = 0; i < level.triangles.size(); ++i) {
    double furthest = 0;
    for (const uint32_t corner : level.triangles[i].vertices)
      furthest =
          std::max(furthest, glm::distance(glm::dvec3(level.points[corner]), glm::dvec3(before[corner])));
    moved = std::max(moved, furthest);
    if (known) largest = std::max(largest, errors[i] + furthest);
  }
  return known ? std::min(largest, bound + moved) : bound + moved;
}

}  // namespace triptych
