// Deltas of visible sets as few bytes.
#pragma once

#include "visibility/visible_set.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// A message cannot hold more ids than this.
inline constexpr size_t delta_limit = size_t{1} << 24;

/// Added and removed ids in one ascending sequence of gaps and kinds, arithmetic coded: neighbours of one
/// kind (new siblings) and of both kinds (one scene node at another level of detail) cost little.
/// Deterministic. Error for lists that are not strictly ascending or too long.
std::vector<std::byte> encode_delta(const VisibleDelta& delta);

/// Error (place) for bytes that encode_delta did not write; never allocates much more than the bytes can
/// stand for.
VisibleDelta decode_delta(std::span<const std::byte> bytes, const std::string& place);

}  // namespace triptych
