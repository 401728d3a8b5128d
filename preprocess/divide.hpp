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
  /// How many border points only these parts have, and the first of their numbers.
  uint32_t own_borders = 0, first_own = 0;
};

/// Splits the surface until every part is within the limits. `shared`, sorted: points that other surfaces may
/// have too. They are border points and have numbers already, below `first_own`. Points that several of the
/// parts have are border points as well, and get the numbers from there on.
Division divide(const Surface& surface, const PartitionLimits& limits, std::span<const SharedPoint> shared,
                uint32_t first_own);

}  // namespace triptych
