// The visible set of one frame as drawables of the next frame's cut: what the occlusion representation is
// drawn from.
#pragma once

#include "lod/cut.hpp"
#include "visibility/visible_set.hpp"

namespace triptych {

/// Each drawable's scene node in the cut (kept, perhaps at another level of detail), or its ancestor there,
/// or all its descendants there; what left the frustum maps to nothing. In draw rank order under `cell`, each
/// once.
std::vector<DrawableId> map_to_cut(const Skeleton& skeleton, const glm::ivec3& cell, const Cut& cut,
                                   const VisibleSet& visible);

}  // namespace triptych
