// What moves of an expanded skeleton: placed sub-hierarchies that follow joints, whole.
#pragma once

#include "scene/motion.hpp"
#include "scene/skeleton.hpp"

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace triptych {

class Poses;

/// A placed sub-hierarchy, with those that are placed in it.
struct MovingInstance {
  uint32_t joint = 0;           ///< takes its space to the model's
  SceneNodeId scene_node = 0;   ///< the one that stands for it; its box holds it at all times
  Box box;                      ///< of all of it, in its own space
  std::vector<uint32_t> inner;  ///< its transforms: indices into MovingParts::transforms
};

/// A scene node of a moving instance.
struct MovingNode {
  uint32_t instance = 0;  ///< index into MovingParts::instances
  Box box;                ///< in the instance's space; holds those of its children
};

/// A transform of a moving instance.
struct MovingTransform {
  uint32_t instance = 0;
  Affine to_instance{1};  ///< positions of a chunk to the instance's space
};

/// In the skeleton that it belongs to, boxes of what moves hold it at all times, and transforms are those at
/// time 0.
struct MovingParts {
  Motion motion;
  std::vector<MovingInstance> instances;
  std::vector<uint32_t> node_of;       ///< for each scene node an index into `nodes`, or no_id: it rests
  std::vector<uint32_t> transform_of;  ///< the same for each transform
  std::vector<MovingNode> nodes;
  std::vector<MovingTransform> transforms;

  /// Where all of it is at a time (seconds). Safe to call from several threads; the same poses as before for
  /// the same time, as long as they are held or few others were asked for, so that what was evaluated is not
  /// evaluated again. They must not outlive this.
  std::shared_ptr<const Poses> poses_at(double time) const;

  MovingParts();
  ~MovingParts();
  MovingParts(const MovingParts&) = delete;
  MovingParts& operator=(const MovingParts&) = delete;

 private:
  mutable std::mutex mutex_;
  mutable std::vector<std::shared_ptr<Poses>> kept_;  ///< the latest last
  mutable uint64_t begun_ = 0;
};

}  // namespace triptych
