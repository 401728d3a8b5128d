// Which levels are made to be seen from outside: some of what others cover is left out of them. The section
// SEEN; docs/pack-format.md describes every byte.
#pragma once

#include "scene/skeleton.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// The section's bytes. by_chunk: Skeleton::seen_from_outside.
std::vector<std::byte> encode_seen_from_outside(const std::vector<bool>& by_chunk);
/// For each of so many chunks. Error (place, byte) for bytes that are no such section.
std::vector<bool> decode_seen_from_outside(std::span<const std::byte> bytes, size_t chunks,
                                           const std::string& place);

/// Whether any chunk of the drawable is made to be seen from outside.
bool is_seen_from_outside(const Skeleton& skeleton, const Drawable& drawable);

}  // namespace triptych
