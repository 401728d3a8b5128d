// Sets of drawables, and the difference between two of them.
#pragma once

#include "scene/skeleton.hpp"

#include <vector>

namespace triptych {

/// Drawable ids, ascending, each once (the papers' potentially visible set).
using VisibleSet = std::vector<DrawableId>;

/// What turns one visible set into another; both lists ascending, each id once.
struct VisibleDelta {
  std::vector<DrawableId> added, removed;
  size_t size() const { return added.size() + removed.size(); }
  bool operator==(const VisibleDelta&) const = default;
};

/// The delta with before − removed ∪ added = after.
VisibleDelta difference(const VisibleSet& before, const VisibleSet& after);
/// The same into an existing delta, whose memory is reused.
void difference(const VisibleSet& before, const VisibleSet& after, VisibleDelta& delta);

/// (set − removed) ∪ added (interactive-display-2003 §4.4). Returns false, and leaves the set as it was,
/// where an added id is in the set already, a removed one is not in it, or a list is not ascending: then the
/// sender and the receiver do not agree on the set.
bool apply_delta(const VisibleDelta& delta, VisibleSet& set);

}  // namespace triptych
