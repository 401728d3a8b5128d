// From parts to what a pack says of closed surfaces.
#pragma once

#include "preprocess/leaf.hpp"
#include "preprocess/parts.hpp"
#include "scene/closed_surfaces.hpp"

#include <span>

namespace triptych {

/// Of the chunks of all parts' finest levels. chunks: how many chunks the pack has.
ClosedSurfaces closed_surfaces_of(const Parts& parts, std::span<const PartLevels> levels, size_t chunks);

}  // namespace triptych
