// Which scene nodes show something: so that whoever looks along a ray finds it from the root on.
#pragma once

#include "scene/skeleton.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace triptych {

/// Of drawables in any order; fastest where they ascend. All that is given must outlive it.
class ShownNodes {
 public:
  ShownNodes(const Skeleton& skeleton, std::span<const DrawableId> shown)
      : skeleton_(skeleton), shown_(shown) {
    if (std::is_sorted(shown.begin(), shown.end())) return;
    sorted_.assign(shown.begin(), shown.end());
    std::sort(sorted_.begin(), sorted_.end());
    shown_ = sorted_;
  }
  ShownNodes(const ShownNodes&) = delete;
  ShownNodes& operator=(const ShownNodes&) = delete;

  /// The drawable of the scene node itself that is shown; no_id where there is none.
  DrawableId of(SceneNodeId node) const {
    const SceneNode& at = skeleton_.scene_nodes[node];
    const auto found = std::lower_bound(shown_.begin(), shown_.end(), at.first_drawable);
    return found != shown_.end() && *found - at.first_drawable < at.drawable_count ? *found : no_id;
  }

 private:
  const Skeleton& skeleton_;
  std::vector<DrawableId> sorted_;
  std::span<const DrawableId> shown_;
};

}  // namespace triptych
