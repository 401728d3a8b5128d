// How many of a model's things are solid: have cut surfaces where a section goes through them.
#pragma once

#include "scene/chunk.hpp"
#include "scene/pack.hpp"

#include <cstdint>

namespace triptych {

/// Whether all triangles of the chunk are outward.
bool is_solid(const Chunk& chunk);

struct SolidCounts {
  /// At full detail: placements, and those that are proven solid as a whole (Chunk::outward).
  uint64_t placements = 0, solid_placements = 0;
  /// Source objects that anything shows, and those of which all placements are solid.
  uint64_t objects = 0, solid_objects = 0;
};

/// Reads every chunk of a leaf's finest drawable, on all cores. Error (pack) for one that is damaged.
SolidCounts count_solids(const Pack& pack);

}  // namespace triptych
