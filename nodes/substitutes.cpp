#include "nodes/substitutes.hpp"

#include "lod/cut.hpp"
#include "residency/take.hpp"

#include <algorithm>

namespace triptych {

bool Substitutes::is_there(DrawableId id) const {
  return std::ranges::all_of(hierarchy_.placements_of(id), [&](const Placement& placement) {
    return device_.has_chunk(placement.chunk) || ready_.contains(placement.chunk);
  });
}

/// It will never be there, and what else it has is not worth reading.
bool Substitutes::is_damaged(DrawableId id) const {
  return std::ranges::any_of(hierarchy_.placements_of(id), [&](const Placement& placement) {
    return device_.is_damaged(placement.chunk) || unreadable_.contains(placement.chunk);
  });
}

DrawableId Substitutes::nearest(const FrameView& view, DrawableId id) {
  DrawableId found = no_id, coarsest = no_id, next = id + 1;
  between_.clear();
  for (SceneNodeId of = skeleton_.drawables[id].scene_node; of != no_id && found == no_id;) {
    const SceneNode& node = skeleton_.scene_nodes[of];
    for (; next < node.first_drawable + node.drawable_count && found == no_id; ++next) {
      if (!may_stand_for_node(view, next)) continue;
      coarsest = next;
      if (is_there(next)) {
        found = next;
      } else if (!is_damaged(next)) {
        between_.push_back(next);
      }
    }
    of = node.parent;
    if (of != no_id) next = skeleton_.scene_nodes[of].first_drawable;
  }
  float priority = urgent;
  for (const DrawableId level : between_) {
    priority += 1;
    for (const auto& [chunk, transform] : hierarchy_.placements_of(level)) {
      if (!device_.has_chunk(chunk) && !device_.is_damaged(chunk)) residency_.expect(chunk, priority);
    }
  }
  return found != no_id ? found : coarsest;
}

/// The chosen one of the highest scene node that the drawable is below or of; itself where there is none.
DrawableId Substitutes::topmost(DrawableId id) const {
  DrawableId result = id;
  for (SceneNodeId of = skeleton_.drawables[id].scene_node; of != no_id;
       of = skeleton_.scene_nodes[of].parent) {
    const auto found = chosen_.find(of);
    if (found != chosen_.end()) result = found->second;
  }
  return result;
}

size_t Substitutes::replace(const FrameView& view, VisibleSet& drawables) {
  chosen_.clear();
  ready_ = residency_.ready();
  for (const auto& [chunk, why] : residency_.unreadable()) {
    if (unreadable_.insert(chunk).second) say_damaged(why);
  }
  size_t missing = 0;
  for (const DrawableId id : drawables) {
    if (is_there(id)) continue;
    ++missing;
    const DrawableId other = nearest(view, id);
    if (other == no_id) continue;
    // Of two levels of one scene node the coarser one: the finer one may not be there.
    DrawableId& chosen = chosen_.try_emplace(skeleton_.drawables[other].scene_node, other).first->second;
    chosen = std::max(chosen, other);
  }
  if (chosen_.empty()) return missing;
  for (DrawableId& id : drawables) id = topmost(id);
  std::sort(drawables.begin(), drawables.end());
  drawables.erase(std::unique(drawables.begin(), drawables.end()), drawables.end());
  return missing;
}

}  // namespace triptych
