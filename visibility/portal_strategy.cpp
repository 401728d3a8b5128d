#include "visibility/portal_strategy.hpp"

#include <algorithm>
#include <utility>

namespace triptych {

PortalStrategy::PortalStrategy(std::shared_ptr<const CellGraph> cells)
    : cells_(std::move(cells)), portals_(*cells_) {}

const std::string& PortalStrategy::name() const {
  static const std::string name = "portals";
  return name;
}

void PortalStrategy::list_seen(const FrameView& view) {
  portals_.begin(view);
  open_.assign(1, 0);
  while (!open_.empty()) {
    const SceneNodeId id = open_.back();
    open_.pop_back();
    const DrawableId choice = choose_level(view, id);
    if (choice == no_id) continue;
    const SceneNode& node = view.skeleton->scene_nodes[id];
    ++result_.tests;
    if (!portals_.may_see(view.box(id))) {
      if (node.child_count > 0) ++result_.hidden_subtrees;
      continue;
    }
    if (choice != Cut::inner) {
      result_.visible.push_back(choice);
      continue;
    }
    for (uint32_t child = 0; child < node.child_count; ++child) open_.push_back(node.first_child + child);
  }
}

const CullResult& PortalStrategy::run(const FrameView& view, const VisibleSet& previous, FrameTarget&,
                                      CullSink& sink) {
  result_.clear();
  if (PortalView::applies_to(view)) {
    list_seen(view);
  } else {
    const std::vector<DrawableId>& cut = whole_cut_.list(view);
    result_.visible.assign(cut.begin(), cut.end());
  }
  result_.selected = result_.visible.size();
  std::sort(result_.visible.begin(), result_.visible.end());
  packet_.watermark = everything_decided;
  difference(previous, result_.visible, packet_.delta);
  sink.take(packet_);
  return result_;
}

}  // namespace triptych
