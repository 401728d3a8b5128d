// What levels of detail leave out: triangles that lie right beneath others, once errors are larger than that.
#pragma once

#include "preprocess/hlod.hpp"

#include <optional>

namespace triptych {

/// Whether it is covered, and the distance of its class at most so many lattice steps.
bool is_left_out(const Triangle& triangle, double distance);

/// Without the covered triangles whose distance from the others (that of their class) is at most `distance`,
/// lattice steps. Nothing where none would be left out, or all.
std::optional<Piece> without_covered(const Piece& piece, double distance);
/// The same for geometry on its way to HLODs. The furthest distance of one that was left out, lattice steps;
/// its error is not changed.
double leave_out_covered(Baked& baked, double distance);

/// A triangle a step wide in place of a surface all of which is covered.
Surface speck(const Surface& surface);

}  // namespace triptych
