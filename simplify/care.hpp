// Levels that are shown with more care than their distance asks for, since being off by a pixel shows: of
// things about as thin or as small as a pixel, which cover the middle of one here and there, and others if
// they are off.
#pragma once

#include "simplify/simplify.hpp"

#include <span>

namespace triptych {

/// Raises the bounds of a surface's levels if most of its cover is of wires that are about as thin as they.
void take_care_of_wires(const Surface& surface, std::span<Level> levels);
/// The bound of something in place of one wire, raised likewise.
double bound_of_wire(double bound, double thickness);

/// Raises the bounds of levels of what is scattered, where most of the cover is of things about as large.
void take_care_of_scattered(const Surface& surface, std::span<Level> levels);

}  // namespace triptych
