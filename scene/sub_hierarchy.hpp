// What a pack holds where groups of objects repeat: hierarchies that are stored once, and the scene nodes
// that stand for them under transforms.
#pragma once

#include "scene/motion.hpp"
#include "scene/skeleton.hpp"

#include <cstdint>
#include <vector>

namespace triptych {

/// A scene node that stands for a sub-hierarchy: stored without children, and an inner scene node whose only
/// child is the sub-hierarchy's root when the skeleton is expanded. It may have drawables of its own.
struct HierarchyInstance {
  SceneNodeId scene_node = 0;
  uint32_t sub_hierarchy = 0;
  uint32_t transform = 0;  ///< the sub-hierarchy's space to that of the hierarchy that the scene node is in
  double stretch = 1;      ///< upper bound of the factor by which the transform stretches lengths
  bool operator==(const HierarchyInstance&) const = default;
};

/// A hierarchy in its own space; its ids are local, starting at 0. Chunks, lattices and palette are those of
/// the pack.
struct SubHierarchy {
  uint32_t lattice = 0;  ///< index into Skeleton::lattices: the lattice of its scene nodes' boxes
  std::vector<SceneNode> scene_nodes;  ///< as Skeleton's; errors of drawables are lengths in its own space
  std::vector<Drawable> drawables;
  std::vector<Placement> placements;  ///< Placement::transform: index into the transforms below
  std::vector<Affine> transforms;     ///< a chunk's positions to the sub-hierarchy's space; 0 is the identity
  std::vector<HierarchyInstance> instances;  ///< of sub-hierarchies before this one, by ascending scene node
};

/// What moves: placed sub-hierarchies. The boxes of the scene nodes that stand for them hold them at all
/// times, and their transforms are those at time 0.
struct StoredMotion {
  struct Instance {
    uint32_t instance = 0;  ///< index into StoredSkeleton::instances; ascending
    uint32_t joint = 0;     ///< index into Motion::joints: takes the sub-hierarchy's space to the model's
    bool operator==(const Instance&) const = default;
  };
  Motion motion;
  std::vector<Instance> instances;
  bool empty() const { return instances.empty(); }
};

/// A skeleton as a pack holds it. Without instances it is the surrounding hierarchy alone.
struct StoredSkeleton {
  Skeleton surrounding;                      ///< not expanded: Skeleton::instances is empty
  std::vector<HierarchyInstance> instances;  ///< in the surrounding hierarchy, by ascending scene node
  std::vector<SubHierarchy> sub_hierarchies;
  StoredMotion motion = {};  ///< of instances in the surrounding hierarchy
};

}  // namespace triptych
