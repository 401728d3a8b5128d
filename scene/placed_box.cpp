#include "scene/placed_box.hpp"

#include <glm/common.hpp>
#include <glm/vec4.hpp>

namespace triptych {

LatticeBox placed_box(const Skeleton& skeleton, const Placement& placement, const LatticeBox& local,
                      const LatticeBox& within) {
  const uint32_t lattice = skeleton.chunks[placement.chunk].lattice;
  LatticeBox box = local;
  if (lattice != 0 || placement.transform != 0) {
    const Box of_mesh = skeleton.lattices[lattice].box(local);
    const Box outer = skeleton.lattice().box(within);
    const Affine& transform = skeleton.transforms[placement.transform];
    Box placed;
    for (int i = 0; i < 8; ++i) placed.extend(transform * glm::dvec4(of_mesh.corner(i), 1));
    // Where the transform's result is not a number, the outer box's side is kept.
    placed = {glm::max(outer.lo, placed.lo), glm::min(outer.hi, placed.hi)};
    if (placed.empty()) return within;
    box = skeleton.lattice().enclosing(placed);
  }
  // A step for rounding in the transform.
  box = {glm::max(within.lo, box.lo - 1), glm::min(within.hi, box.hi + 1)};
  return box.empty() ? within : box;
}

}  // namespace triptych
