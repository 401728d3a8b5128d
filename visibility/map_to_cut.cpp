#include "visibility/map_to_cut.hpp"

#include "base/inject.hpp"

#include <algorithm>

namespace triptych {

std::vector<DrawableId> map_to_cut(const Skeleton& skeleton, const glm::ivec3& cell, const Cut& cut,
                                   const VisibleSet& visible) {
  std::vector<DrawableId> mapped;
  std::vector<SceneNodeId> open;
  if (injected(Fault::wrong_ancestor)) {
    // Parents instead of what is in the cut: coarser surfaces that may stand in front of the true ones.
    for (const DrawableId id : visible) {
      const SceneNodeId parent = skeleton.scene_nodes[skeleton.drawables[id].scene_node].parent;
      const SceneNode& node = skeleton.scene_nodes[parent == no_id ? 0 : parent];
      if (node.drawable_count > 0) mapped.push_back(node.first_drawable + node.drawable_count - 1);
    }
  } else {
    for (const DrawableId id : visible) {
      SceneNodeId node = skeleton.drawables[id].scene_node;
      if (cut.choice[node] == Cut::inner) {
        open.push_back(node);
        continue;
      }
      while (node != no_id && cut.choice[node] == no_id) node = skeleton.scene_nodes[node].parent;
      if (node != no_id && cut.choice[node] != Cut::inner) mapped.push_back(cut.choice[node]);
    }
  }
  while (!open.empty()) {
    const SceneNode& node = skeleton.scene_nodes[open.back()];
    open.pop_back();
    for (SceneNodeId child = node.first_child; child < node.first_child + node.child_count; ++child) {
      if (cut.choice[child] == Cut::inner) open.push_back(child);
      if (cut.choice[child] < Cut::inner) mapped.push_back(cut.choice[child]);
    }
  }
  std::sort(mapped.begin(), mapped.end());
  mapped.erase(std::unique(mapped.begin(), mapped.end()), mapped.end());
  sort_by_rank(skeleton, cell, mapped);
  return mapped;
}

}  // namespace triptych
