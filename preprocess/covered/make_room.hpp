// Levels of detail keep what is covered beneath what covers it: up to some error there is room between them,
// and beyond it what nobody sees is left out.
#pragma once

#include "preprocess/covered/covered_report.hpp"
#include "preprocess/hlod.hpp"
#include "preprocess/parts.hpp"

#include <optional>

namespace triptych {

/// Finds what is covered in all hierarchies, and tells the parts: which of their triangles, and which errors
/// their levels may not have, as those of what covers them. `memory`: bytes that geometry may take at a time,
/// roughly.
CoveredReport make_room(Parts& parts, const SpoolFile& geometry, uint64_t memory);

/// Without the covered triangles whose distance from the others (that of their class) is at most `distance`,
/// lattice steps. Nothing where none would be left out, or all.
std::optional<Piece> without_covered(const Piece& piece, double distance);
/// The same for geometry on its way to HLODs. The furthest distance of one that was left out, lattice steps;
/// its error is not changed.
double leave_out_covered(Baked& baked, double distance);

/// A triangle a step wide in place of a surface all of which is covered.
Surface speck(const Surface& surface);

}  // namespace triptych
