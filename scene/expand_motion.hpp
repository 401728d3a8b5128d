// What expanding a skeleton notes of what moves.
#pragma once

#include "scene/moving_parts.hpp"
#include "scene/sub_hierarchy.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace triptych {

/// Follows the expansion, instance by instance, each after those that it is in.
class MovingExpansion {
 public:
  /// skeleton: with the instances of the surrounding hierarchy, none of them expanded.
  MovingExpansion(StoredMotion motion, const Skeleton& skeleton);

  /// An instance whose scene nodes and transforms are about to be added; whether it moves. index: its own
  /// among the skeleton's. instance: with the ids that it will have, and still with the transform that it is
  /// placed by. first_transform: the first of its own.
  bool begin(size_t index, const ExpandedInstance& instance, uint32_t first_transform,
             const SubHierarchy& hierarchy, const Lattice& lattice);
  /// Once all are expanded.
  std::shared_ptr<const MovingParts> finish(const Skeleton& skeleton);

 private:
  void add_node(SceneNodeId node, uint32_t moving, const Box& box);

  std::shared_ptr<MovingParts> parts_ = std::make_shared<MovingParts>();
  std::vector<uint32_t> moving_;  ///< for each instance of the surrounding hierarchy, or no_id
};

}  // namespace triptych
