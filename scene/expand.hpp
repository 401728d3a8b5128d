// Expands sub-hierarchies in each of their places: from a skeleton as it is stored to one of plain arrays.
#pragma once

#include "scene/sub_hierarchy.hpp"

#include <cstdint>
#include <string>

namespace triptych {

/// An expanded skeleton takes no more memory than this, bytes: a small file can ask for any amount.
inline constexpr uint64_t max_expanded_bytes = uint64_t{1} << 30;

/// The whole tree. Scene nodes and drawables of the surrounding hierarchy keep their ids; behind them come
/// those of each instance, in the order of a queue: the surrounding hierarchy's instances first, then those
/// in the sub-hierarchy of the first one, and so on. The id of what is in an instance is the instance's first
/// one plus the local one. Boxes are placed on the model's lattice (the smallest that hold the local one's
/// placed corners, one step more for rounding, within the parent's box); errors are the local ones times the
/// stretches on the way; transforms are composed in double.
/// The skeleton must have passed check_skeleton(). Error (place) where ids would not fit 32
/// bits, the skeleton would take more than `max_bytes`, or numbers leave the range of doubles.
Skeleton expand(StoredSkeleton stored, const std::string& place, uint64_t max_bytes = max_expanded_bytes);

}  // namespace triptych
