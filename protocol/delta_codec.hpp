// Deltas of visible sets in few bytes.
#pragma once

#include "visibility/visible_set.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// A message cannot add more ids than this.
inline constexpr size_t delta_limit = size_t{1} << 24;

/// How many ids an encoded delta adds and removes.
struct DeltaCounts {
  size_t added = 0, removed = 0;
};

/// The delta as the change of a set that the receiver has as well: arithmetic coded, removed ids by their
/// place in the set, added ones by the gaps between them. Adjacent ids cost little, and an empty delta takes
/// no byte. Deterministic. Error for lists that are not strictly ascending, removed ids that are not in the
/// set, and more added ones than a message holds.
std::vector<std::byte> encode_delta(const VisibleDelta& delta, const VisibleSet& before);

/// Error (place) for bytes that encode_delta cannot have written for this set; never reads beyond their end.
VisibleDelta decode_delta(std::span<const std::byte> bytes, const VisibleSet& before,
                          const std::string& place);

/// What the bytes claim, without the set. Never fails, whatever the bytes.
DeltaCounts delta_counts(std::span<const std::byte> bytes);

}  // namespace triptych
