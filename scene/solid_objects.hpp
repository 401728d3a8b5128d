// How many of a model's things are solid: have cut surfaces where a section goes through them.
#pragma once

#include "scene/pack.hpp"

#include <cstdint>

namespace triptych {

struct SolidCounts {
  /// At full detail: placements, and those that are closed as a whole (ClosedSurfaces).
  uint64_t placements = 0, solid_placements = 0;
  /// Source objects that anything shows, and those of which all placements are solid.
  uint64_t objects = 0, solid_objects = 0;
};

/// Error (pack) where what it says of objects is damaged.
SolidCounts count_solids(const Pack& pack);

}  // namespace triptych
