#include "lod/lazy_cut.hpp"

namespace triptych {

LazyCut::LazyCut(const Skeleton& skeleton)
    : skeleton_(skeleton),
      known_(skeleton.scene_nodes.size()),
      choices_(skeleton.scene_nodes.size(), no_id) {}

void LazyCut::begin(const FrameView& view) {
  view_ = view;
  known_.clear();
  selected_ = 0;
}

void LazyCut::begin(const FrameView& view, const Cut& cut) {
  begin(view);
  choices_ = cut.choice;
  for (size_t node = 0; node < choices_.size(); ++node) known_.mark(node);
  selected_ = cut.drawables.size();
}

DrawableId LazyCut::choice(SceneNodeId node) {
  if (known_.marked(node)) return choices_[node];
  const SceneNodeId parent = skeleton_.scene_nodes[node].parent;
  DrawableId chosen = no_id;
  if (parent == no_id || choice(parent) == Cut::inner) {
    chosen = choose_level(*view_, node);
    selected_ += chosen < Cut::inner;
  }
  known_.mark(node);
  choices_[node] = chosen;
  return chosen;
}

}  // namespace triptych
