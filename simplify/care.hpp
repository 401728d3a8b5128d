// Levels that are shown with more care than their distance asks for.
#pragma once

#include "simplify/simplify.hpp"

#include <vector>

namespace triptych {

/// Raises the bounds of levels of a surface where being off by a pixel shows: of things about as thin or as
/// small as a pixel, which cover the middle of one here and there, and others if they are off. Where most of
/// the cover is of wires that are thinner than the bound (not in levels that ignore colours), or of things
/// about as large as the bound that are scattered.
void take_care(const Surface& surface, Colors colors, std::vector<Level>& levels);

}  // namespace triptych
