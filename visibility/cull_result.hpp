// What a strategy decided of a frame, and what that took.
#pragma once

#include "visibility/visible_set.hpp"

#include <cstdint>

namespace triptych {

struct CullResult {
  VisibleSet visible;     ///< V(i)
  uint64_t selected = 0;  ///< drawables of cut i that were selected; what nobody looked at is not counted
  uint64_t tests = 0;     ///< boxes tested, inner scene nodes' included
  uint64_t batches = 0;
  uint64_t hidden_subtrees = 0;  ///< inner scene nodes that were hidden at once
  uint64_t untested = 0;         ///< drawables that count as visible because their bounds are unknown

  /// Empties it and keeps its room.
  void clear() {
    visible.clear();
    selected = tests = batches = hidden_subtrees = untested = 0;
  }
};

}  // namespace triptych
