// The quality of a hierarchy, computed from its skeleton.
#pragma once

#include "base/distribution.hpp"
#include "scene/skeleton.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

namespace triptych {

/// Scene nodes equally far from the root.
struct HierarchyLevel {
  uint64_t scene_nodes = 0, leaves = 0;
  uint64_t drawables = 0;
  uint64_t triangles = 0;  ///< of all those drawables, each placement counted
};

struct HierarchyQuality {
  Distribution depth;  ///< of leaves, in scene nodes from the root, which has depth 1
  /// Of inner nodes: the leaves below the lightest child over those below the heaviest.
  Distribution balance;
  Distribution overlap;  ///< of inner nodes: shared volume of pairs of children over the node's own volume
  std::vector<HierarchyLevel> levels;  ///< the root's first
};

/// Volumes are counted in cells of the model lattice, so that flat boxes have some too.
HierarchyQuality hierarchy_quality(const Skeleton& skeleton);

nlohmann::json to_json(const HierarchyQuality& quality);

}  // namespace triptych
