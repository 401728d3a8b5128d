#include "scene/lattice.hpp"

#include <algorithm>

namespace triptych {

Lattice make_lattice(const Box& box, int bits) {
  if (box.empty()) return {};
  const glm::dvec3 size = box.hi - box.lo;
  const double longest = std::max({size.x, size.y, size.z});
  const glm::dvec3 furthest = glm::max(glm::abs(box.lo), glm::abs(box.hi));
  // A step below the resolution of doubles at the model's position would be lost in origin + step · point.
  const double resolution = std::max({furthest.x, furthest.y, furthest.z, 1e-300}) * 0x1p-50;
  Lattice lattice;
  lattice.step = std::exp2(std::ceil(std::log2(std::max(longest * std::exp2(-bits), resolution))));
  // Of coarse steps, so that a box that grows a little keeps its lattice, and what lies on it its numbers.
  const double coarse = lattice.step * std::exp2(bits - 4);
  lattice.origin = glm::round((box.lo + size * 0.5) / coarse) * coarse;
  return lattice;
}

}  // namespace triptych
