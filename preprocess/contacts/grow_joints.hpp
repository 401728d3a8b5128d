// Flat ends that stand against thin bodies: panes between mullions, rails against posts.
#pragma once

#include "preprocess/hlod.hpp"

#include <cstdint>
#include <span>

namespace triptych {

/// Moves flat faces that lie against rods (Cover::is_rod) of another component into those, half way
/// through, so that no gap opens where a level gives up the rod: panes on both sides of a mullion meet in its
/// middle then. Only faces all of whose neighbours go on backwards from them at right angles, so that nothing
/// that shows is moved, where the rod is behind all of the face, and by no more than `most` lattice steps.
/// fixed: a flag for each point; those stay. Covered triangles are
/// taken to be that much further from what covers them. Returns how far a point moved at
/// most, lattice steps.
double grow_joints(Baked& baked, std::span<const uint8_t> fixed, double most);

}  // namespace triptych
