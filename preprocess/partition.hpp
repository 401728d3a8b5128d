// Top-down partition: triangles of a mesh into parts, objects of a cluster into smaller ones (section 2.2 of
// Manocha, Interactive Display of Complex Environments, 2003, steps 1 and 3).
#pragma once

#include "preprocess/object_extent.hpp"
#include "simplify/surface.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

struct PartitionLimits {
  /// No part has more triangles than this.
  uint64_t triangles = 8192;
  /// A part whose box has a longer diagonal is split while it holds more than `large_triangles`; lattice
  /// steps.
  double diagonal = 1e300;
  uint64_t large_triangles = 4096;
};

/// Splits at the middle of the longest axis of the triangles' centres, or at their median where the middle
/// would be too uneven. Every triangle is in exactly one part; the parts, and the triangles in them, are in a
/// fixed order.
std::vector<std::vector<uint32_t>> partition_triangles(const Surface& surface, const PartitionLimits& limits);

/// Splits the group in the same way by the centres of its members' boxes, until no part holds more triangles
/// (single objects stay whole). Returns indices into `objects`.
std::vector<std::vector<uint32_t>> partition_objects(std::span<const ObjectExtent> objects,
                                                     std::span<const uint32_t> group, uint64_t triangles);

}  // namespace triptych
