#include "scene/placed_box.hpp"

#include <glm/common.hpp>
#include <glm/vec4.hpp>

namespace triptych {

namespace {
/// A step for rounding in the transform.
LatticeBox with_margin(const LatticeBox& box, const LatticeBox& within) {
  const LatticeBox around{glm::max(within.lo, box.lo - 1), glm::min(within.hi, box.hi + 1)};
  return around.empty() ? within : around;
}
}  // namespace

LatticeBox placed_box(const Skeleton& skeleton, const Placement& placement, const LatticeBox& local,
                      const LatticeBox& within) {
  const uint32_t lattice = skeleton.chunks[placement.chunk].lattice;
  if (lattice == 0 && placement.transform == 0) return with_margin(local, within);
  return placed_box(skeleton, lattice, skeleton.transforms[placement.transform], local, within);
}

LatticeBox placed_box(const Skeleton& skeleton, uint32_t lattice, const Affine& transform,
                      const LatticeBox& local, const LatticeBox& within) {
  const Box of_mesh = skeleton.lattices[lattice].box(local);
  const Box outer = skeleton.lattice().box(within);
  Box placed;
  for (int i = 0; i < 8; ++i) placed.extend(transform * glm::dvec4(of_mesh.corner(i), 1));
  // Where the transform's result is not a number, the outer box's side is kept.
  placed = {glm::max(outer.lo, placed.lo), glm::min(outer.hi, placed.hi)};
  if (placed.empty()) return within;
  return with_margin(skeleton.lattice().enclosing(placed), within);
}

}  // namespace triptych
