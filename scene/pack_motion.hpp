// The section MOVE: what of a pack's placed sub-hierarchies moves, and how. docs/pack-format.md describes
// every byte.
#pragma once

#include "scene/sub_hierarchy.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace triptych {

std::vector<std::byte> encode_motion(const StoredMotion& stored);
/// Error (place, byte) for bytes that are no such section of a pack with so many instances in its surrounding
/// hierarchy.
StoredMotion decode_motion(std::span<const std::byte> bytes, size_t instances, const std::string& place);

}  // namespace triptych
