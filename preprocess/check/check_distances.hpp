// How far the drawables of a pack are from their source: the finest leaf drawables of their subtree.
#pragma once

#include "scene/pack.hpp"

#include <functional>
#include <span>
#include <vector>

namespace triptych {

/// Whether the drawable is the finest one of a leaf: part of the source that others are compared with.
bool is_source(const Skeleton& skeleton, DrawableId id);

/// For each drawable one that is as far from its source: itself, or the one with the same local id in another
/// instance of the sub-hierarchy, whose transform differs only by a rigid motion or a mirror image.
std::vector<DrawableId> equally_distant(const Skeleton& skeleton);

/// For each drawable the largest two-sided distance to its source that was found, at about `points` points
/// over all drawables; 0 for the source itself, NaN where a chunk is damaged. A lower bound of the true
/// distance, the same for the same pack.
std::vector<double> measured_distances(const Pack& pack, uint64_t points);

/// The same for the given drawables alone, in their order. NaN as above. `between` is called now and then, by
/// any thread; if it throws an Error on this and each later call, the measurement ends.
std::vector<double> measured_distances(
    const Pack& pack, std::span<const DrawableId> drawables, uint64_t points,
    const std::function<void()>& between = [] {});

}  // namespace triptych
