// Where hidden objects are: what frames ask of a set that was applied.
#include "scene/hidden_objects.hpp"

#include <algorithm>

namespace triptych {

namespace {
bool meet(const LatticeBox& a, const LatticeBox& b) {
  return a.lo.x <= b.hi.x && a.lo.y <= b.hi.y && a.lo.z <= b.hi.z && b.lo.x <= a.hi.x && b.lo.y <= a.hi.y &&
         b.lo.z <= a.hi.z;
}
}  // namespace

std::span<const PlacementRun> HiddenObjects::hidden_placements(SceneNodeId leaf) const {
  if (marks_[leaf] < first_leaf) return {};
  const uint32_t index = marks_[leaf] - first_leaf, begin = index == 0 ? 0 : ends_[index - 1];
  return std::span(runs_).subspan(begin, ends_[index] - begin);
}

bool HiddenObjects::hides(SceneNodeId leaf, uint32_t placement) const {
  if (marks_[leaf] == gone) return true;
  const auto runs = hidden_placements(leaf);
  return std::any_of(runs.begin(), runs.end(),
                     [&](const PlacementRun& run) { return placement >= run.first && placement < run.end; });
}

bool HiddenObjects::touches(const LatticeBox& box) const {
  const auto& nodes = skeleton_.scene_nodes;
  SceneNodeId id = 0;
  while (id < nodes.size()) {
    if (marks_[id] != shown && meet(nodes[id].box, box)) {
      if (nodes[id].child_count == 0) return true;
      id = nodes[id].first_child;
      continue;
    }
    // On to the next sibling, of its own or of the nearest one above that has any.
    while (id != 0) {
      const SceneNode& parent = nodes[nodes[id].parent];
      if (id + 1 < parent.first_child + parent.child_count) break;
      id = nodes[id].parent;
    }
    if (id == 0) return false;
    ++id;
  }
  return false;
}

}  // namespace triptych
