// The drawables of all scene nodes: leaves from the levels of their parts, inner nodes bottom-up from their
// children.
#pragma once

#include "preprocess/build_hierarchy.hpp"
#include "preprocess/leaf.hpp"
#include "preprocess/objects.hpp"

#include <span>
#include <vector>

namespace triptych {

/// What a scene node holds before the skeleton is put together.
struct NodeContent {
  LatticeBox box;
  std::vector<Drawable> drawables;    ///< first_placement: in `placements`
  std::vector<Placement> placements;  ///< of all drawables
};

/// For each node of the hierarchy; HLODs are units of `work`.
std::vector<NodeContent> make_node_drawables(const Parts& parts, const Objects& objects,
                                             std::span<const HierarchyNode> nodes,
                                             std::span<const PartLevels> levels, const BuildOptions& options,
                                             BuildWork& work, ImportReport& report);

/// Drawables of fewer triangles than this cost more to handle than to draw: a leaf has none beyond its first.
size_t exit_triangles(const BuildOptions& options);

}  // namespace triptych
