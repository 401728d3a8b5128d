// The final objects: placed parts, clustered and partitioned again; each becomes a leaf of the hierarchy.
#pragma once

#include "preprocess/build.hpp"
#include "preprocess/object_extent.hpp"
#include "preprocess/parts.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

struct Objects {
  std::vector<std::vector<uint32_t>> members;  ///< of each object the indices of its placed parts, ascending
  std::vector<ObjectExtent> extents;           ///< of each object, model space
  ObjectCounts counts;
};

/// Only parts that are small, by triangles and by extent, are grouped; a wall or a slab stays an object of
/// its own, with a box as tight as it is. With HierarchyKind::median_split each placement of a mesh is an
/// object, all its parts together.
Objects make_objects(const Parts& parts, const BuildOptions& options);

}  // namespace triptych
