// The first partition: a mesh's surface into parts, and which of their points they share.
#pragma once

#include "preprocess/buckets.hpp"
#include "preprocess/part.hpp"
#include "preprocess/partition.hpp"

#include <span>
#include <vector>

namespace triptych {

struct Division {
  std::vector<Part> parts;
  /// Border points that only these parts have: their numbers begin with first_own.
  uint32_t own_borders = 0, first_own = 0;
};

/// Splits the surface until every part is within the limits. `shared`, sorted: points that surfaces beyond
/// this one may have too; they are border points, and have numbers already, those below `first_own`. So are
/// points that several of the parts have: they get the numbers from there on.
Division divide(const Surface& surface, const PartitionLimits& limits, std::span<const SharedPoint> shared,
                uint32_t first_own);

}  // namespace triptych
