// Whether a skeleton that was read is consistent: ids in range, parents before children, finite numbers. The
// bytes may come from anywhere; what passes here can be expanded, selected from and drawn.
#pragma once

#include "scene/sub_hierarchy.hpp"

#include <cstdint>
#include <string>

namespace triptych {

/// Error for ids out of range, children before their parents, leaves that have no drawable and are not
/// instances, empty boxes, negative or infinite errors, and instances of a sub-hierarchy that does not come
/// before the hierarchy that they are in. Its place is `place`, or `sub_place` where instances or
/// sub-hierarchies are at fault. geometry_size: bytes of the geometry section, which the chunk table must
/// stay inside.
void check_skeleton(const StoredSkeleton& stored, uint64_t geometry_size, const std::string& place,
                    const std::string& sub_place);

}  // namespace triptych
