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
  /// Of each object, and behind them of each placed sub-hierarchy that holds any; in the hierarchy's space.
  std::vector<ObjectExtent> extents;
  std::vector<uint64_t> leaves;  ///< for each extent how many leaves of the whole tree it stands for
  /// The placed ones among the extents: indices into PlacedParts::sub_hierarchies.
  std::vector<uint32_t> sub_hierarchies;
  std::vector<bool> moving;  ///< for each extent whether it moves; empty where nothing does
  std::vector<uint32_t>
      files;            ///< for each extent which file of the model it is of; empty where there is one
  ObjectCounts counts;  ///< without those of sub-hierarchies
};

/// For each hierarchy. Only parts that are small, by triangles and by extent, are grouped; a wall or a slab
/// stays an object of its own, with a box as tight as it is. A placed sub-hierarchy is an object. With
/// HierarchyKind::median_split each placement of a mesh is an object, all its parts together. Of a model of
/// several files each is grouped by itself: what it becomes does not depend on the others. file_of: for each
/// source object which file it is of; empty where there is one.
std::vector<Objects> make_objects(const Parts& parts, const BuildOptions& options,
                                  std::span<const uint32_t> file_of = {});

}  // namespace triptych
