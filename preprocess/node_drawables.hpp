// The drawables of all scene nodes: leaves from the levels of their parts, inner nodes bottom-up from their
// children.
#pragma once

#include "base/progress.hpp"
#include "preprocess/build_hierarchy.hpp"
#include "preprocess/leaf.hpp"
#include "preprocess/objects.hpp"

#include <span>
#include <vector>

namespace triptych {

/// What a scene node holds before the skeleton is assembled.
struct NodeContent {
  LatticeBox box;
  /// first_placement: in `placements`. Of an inner node there may be none.
  std::vector<Drawable> drawables;
  std::vector<Placement> placements;  ///< of all drawables
  /// Of an inner node, for each drawable the source objects of its triangles
  /// (preprocess/triangle_objects.hpp); empty where the model has none.
  std::vector<std::vector<std::byte>> triangle_objects;
};

/// What a hierarchy looks like from those that it is placed in.
struct HierarchyRoot {
  LatticeBox box;          ///< of all of it, on its lattice
  double error = 0;        ///< of its coarsest geometry, in its own units
  uint32_t triangles = 0;  ///< of that geometry, roughly
  SpoolPlace baked;        ///< where that geometry lies: a Baked on its lattice
};

struct HierarchyDrawables {
  std::vector<NodeContent> contents;  ///< for each node; one that stands for a sub-hierarchy has no drawables
  HierarchyRoot root;                 ///< of a sub-hierarchy
};

/// The placed sub-hierarchy that a leaf stands for, an index into PlacedParts::sub_hierarchies; no_id for a
/// leaf of parts and for an inner node.
uint32_t sub_hierarchy_of(const HierarchyNode& node, const Objects& objects);

/// For each of so many placed parts the place of its leaf (HierarchyNode::first_place).
std::vector<uint32_t> leaf_places(const Objects& objects, std::span<const HierarchyNode> nodes,
                                  size_t placed);

/// The drawables of one hierarchy, an index into Parts::hierarchies; `roots`: of those before it. HLODs are
/// units of `work`. The progress advances by one per node.
HierarchyDrawables make_node_drawables(const Parts& parts, uint32_t hierarchy, const Objects& objects,
                                       std::span<const HierarchyNode> nodes,
                                       std::span<const PartLevels> levels,
                                       std::span<const HierarchyRoot> roots, const BuildOptions& options,
                                       BuildWork& work, Progress& progress, ImportReport& report);

/// Drawables of fewer triangles than this cost more to handle than to draw: a leaf has at most one such
/// drawable.
size_t exit_triangles(const BuildOptions& options);

}  // namespace triptych
