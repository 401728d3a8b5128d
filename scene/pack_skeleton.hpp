// The skeleton as bytes: the pack's sections SKEL and, where groups of objects repeat, SUBH.
#pragma once

#include "scene/sub_hierarchy.hpp"

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// Hands out the bytes of the section up to its last array, the pieces, of which only the count is written:
/// the caller writes that many boxes behind it. The skeleton's own pieces are not written.
void write_skeleton(const Skeleton& skeleton, uint64_t piece_count,
                    const std::function<void(std::span<const std::byte>)>& write);
/// The whole section, with the skeleton's own pieces.
std::vector<std::byte> encode_skeleton(const Skeleton& skeleton);

/// The section SUBH: everything of the stored skeleton but its surrounding hierarchy.
std::vector<std::byte> encode_sub_hierarchies(const StoredSkeleton& stored);

/// Error (place, byte) for bytes that end too soon or too late, and for a skeleton that is not consistent
/// (scene/check_skeleton.hpp). geometry_size: bytes of the geometry section, which the chunk table must stay
/// inside.
Skeleton decode_skeleton(std::span<const std::byte> bytes, uint64_t geometry_size, const std::string& place);

/// A section's bytes and the place that errors name.
struct SectionBytes {
  std::span<const std::byte> bytes;
  std::string place;
};
/// The same for SKEL and SUBH together.
StoredSkeleton decode_skeleton(const SectionBytes& skeleton, const SectionBytes& sub_hierarchies,
                               uint64_t geometry_size);

}  // namespace triptych
