// Whether what was read of a skeleton holds together: ids in range, parents before children, numbers that are
// numbers. Bytes come from anywhere; what passes here can be expanded, selected from and drawn.
#pragma once

#include "scene/sub_hierarchy.hpp"

#include <cstdint>
#include <string>

namespace triptych {

/// Error for ids out of range, children before their parents, leaves without a drawable that are no
/// instances, boxes or errors that are no boxes or errors; instances of a sub-hierarchy that is not before
/// the hierarchy which they are in. Its place is `place`, or `sub_place` where instances or sub-hierarchies
/// are at fault. geometry_size: bytes of the geometry section, which the chunk table must stay inside.
void check_skeleton(const StoredSkeleton& stored, uint64_t geometry_size, const std::string& place,
                    const std::string& sub_place);

}  // namespace triptych
