// The first partition: a mesh's surface into parts, and which of their points they share.
#pragma once

#include "preprocess/buckets.hpp"
#include "preprocess/closed_groups.hpp"
#include "preprocess/part.hpp"
#include "preprocess/partition.hpp"

#include <span>
#include <vector>

namespace triptych {

struct Division {
  std::vector<Part> parts;
  /// For each part what its triangles begin with: closed surfaces that it has alone, if any, as one run; then
  /// those that several of the parts have a share of, by ascending numbers below `bodies`. What follows is
  /// not closed.
  std::vector<std::vector<PartRun>> runs;
  uint32_t bodies = 0;
  /// How many border points only these parts have, and the first of their numbers.
  uint32_t own_borders = 0, first_own = 0;
};

/// Splits the surface until every part is within the limits. closed: find_closed() of it. `shared`, sorted:
/// points that other surfaces may have too. They are border points and have numbers already, below
/// `first_own`. Points that several of the parts have are border points as well, and get the numbers from
/// there on.
Division divide(const Surface& surface, const PartitionLimits& limits, const ClosedTriangles& closed,
                std::span<const SharedPoint> shared, uint32_t first_own);

}  // namespace triptych
