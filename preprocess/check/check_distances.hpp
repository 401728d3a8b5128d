// How far the drawables of a pack are from their source: the finest leaf drawables of their subtree.
#pragma once

#include "scene/pack.hpp"

#include <functional>
#include <span>
#include <vector>

namespace triptych {

/// Whether the drawable is the finest one of a leaf: the source that others are held against.
bool is_source(const Skeleton& skeleton, DrawableId id);

/// For each drawable one that is as far from its source: itself, or, in a sub-hierarchy that stands elsewhere
/// under a transform which differs by a motion or a mirror image alone, the one with the same local id there.
std::vector<DrawableId> equally_distant(const Skeleton& skeleton);

/// For each drawable the largest two-sided distance to its source that was found at about `points` points
/// over all; 0 for the source itself, NaN where a chunk is damaged. A lower bound of the true distance, the
/// same for the same pack.
std::vector<double> measured_distances(const Pack& pack, uint64_t points);

/// The same for the given drawables alone, in their order. NaN as above. `between` is called every now and
/// then, by any thread; an Error that it throws, and would throw again, ends the measurement.
std::vector<double> measured_distances(
    const Pack& pack, std::span<const DrawableId> drawables, uint64_t points,
    const std::function<void()>& between = [] {});

}  // namespace triptych
