#include "visibility/map_to_cut.hpp"

namespace triptych {

CutMapper::CutMapper(const Skeleton& skeleton) : skeleton_(skeleton), added_(skeleton.drawables.size()) {}

void CutMapper::add(DrawableId id) {
  if (added_.mark_first(id)) mapped_.push_back(id);
}

void CutMapper::add_below(LazyCut& cut, SceneNodeId top) {
  open_.assign(1, top);
  while (!open_.empty()) {
    const SceneNode& node = skeleton_.scene_nodes[open_.back()];
    open_.pop_back();
    for (SceneNodeId child = node.first_child; child < node.first_child + node.child_count; ++child) {
      const DrawableId choice = cut.choice(child);
      if (choice == Cut::inner) open_.push_back(child);
      if (choice < Cut::inner) add(choice);
    }
  }
}

const std::vector<DrawableId>& CutMapper::map(LazyCut& cut, const VisibleSet& visible) {
  added_.clear();
  mapped_.clear();
  for (const DrawableId id : visible) {
    SceneNodeId node = skeleton_.drawables[id].scene_node;
    if (!cut.view().rules.map_to_cut) {
      // Without the rule: parents instead of what is in the cut. They are coarser surfaces, which may stand
      // in front of the true ones.
      const SceneNodeId parent = skeleton_.scene_nodes[node].parent;
      const SceneNode& above = skeleton_.scene_nodes[parent == no_id ? 0 : parent];
      if (above.drawable_count > 0) add(above.first_drawable + above.drawable_count - 1);
      continue;
    }
    if (!cut.view().rules.hidden_is_gone && cut.view().hidden(node) == HiddenShare::all) {
      add(id);
      continue;
    }
    if (cut.choice(node) == Cut::inner) {
      add_below(cut, node);
      continue;
    }
    while (node != no_id && cut.choice(node) == no_id) node = skeleton_.scene_nodes[node].parent;
    if (node == no_id) continue;
    if (const DrawableId choice = cut.choice(node); choice != Cut::inner) add(choice);
  }
  sorter_.sort(cut.view(), mapped_);
  return mapped_;
}

}  // namespace triptych
