// The AABB hierarchy over the final objects, top-down (section 2.2 of Manocha 2003, step 4).
#pragma once

#include "preprocess/object_extent.hpp"
#include "scene/skeleton.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// How objects become leaves, and leaves a tree.
enum class HierarchyKind {
  partition_cluster_partition,
  median_split,  ///< the original objects, split at the median along the longest axis: for comparison
};

struct HierarchyNode {
  SceneNodeId parent = no_id;
  SceneNodeId first_child = 0;
  uint32_t child_count = 0;  ///< 0 for a leaf, 2 to 4 otherwise
  uint32_t object = no_id;   ///< of a leaf: the index of its object
  /// The leaves below have these places in depth-first order: first_place up to, not including, end_place.
  uint32_t first_place = 0, end_place = 0;
};

/// Nodes breadth first: a parent before its children, the children of one parent side by side. Ranges are
/// split at the median of their boxes' centres, so that the tree is balanced whatever the boxes are, along
/// the axis that gives the halves the least expected cost. Two levels of splits make one level of up to four
/// children. With HierarchyKind::median_split each split is along the longest axis and makes one level. At
/// least one object must be given; a single one gives a root that is a leaf. `leaves`: how many leaves of the
/// whole tree each object stands for; empty if each is one. An object that stands for a sub-hierarchy counts
/// with all its leaves, and so is as near to the root as its size requires. `files`: which file of the model
/// each is of; empty if there is one. Ranges of several files are split as preprocess/joint_ranges.hpp says.
/// `moving`: which of them move; empty if none does. The first split is of those from the others.
std::vector<HierarchyNode> build_hierarchy(std::span<const ObjectExtent> objects,
                                           HierarchyKind kind = HierarchyKind::partition_cluster_partition,
                                           std::span<const uint64_t> leaves = {},
                                           std::span<const uint32_t> files = {},
                                           const std::vector<bool>& moving = {});

}  // namespace triptych
