// How many ids of a visible set change although the same things show.
#pragma once

#include "scene/skeleton.hpp"
#include "visibility/visible_set.hpp"

#include <cstdint>
#include <set>

namespace triptych {

/// Of the ids that changed, those of scene nodes that stayed visible at another level of detail.
inline uint64_t level_changes(const Skeleton& skeleton, const VisibleSet& before, const VisibleSet& now) {
  const VisibleDelta delta = difference(before, now);
  std::set<SceneNodeId> removed;
  for (const DrawableId id : delta.removed) removed.insert(skeleton.drawables[id].scene_node);
  uint64_t changes = 0;
  for (const DrawableId id : delta.added) changes += removed.count(skeleton.drawables[id].scene_node) ? 2 : 0;
  return changes;
}

}  // namespace triptych
