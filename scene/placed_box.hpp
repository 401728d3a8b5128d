// Boxes of what is placed, on the model's lattice.
#pragma once

#include "scene/skeleton.hpp"

namespace triptych {

/// On the model's lattice: a box that holds what is in `local`, a box of the placement's chunk, plus one
/// step on each side for rounding; clipped to `within`, which holds all that the placement draws.
LatticeBox placed_box(const Skeleton& skeleton, const Placement& placement, const LatticeBox& local,
                      const LatticeBox& within);
/// The same under another transform than the skeleton's, of a chunk on a lattice (index into
/// Skeleton::lattices).
LatticeBox placed_box(const Skeleton& skeleton, uint32_t lattice, const Affine& transform,
                      const LatticeBox& local, const LatticeBox& within);

}  // namespace triptych
