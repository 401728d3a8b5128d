// What a strategy decided for one frame, and how much work that took.
#pragma once

#include "visibility/visible_set.hpp"

#include <cstdint>

namespace triptych {

struct CullResult {
  VisibleSet visible;     ///< V(i)
  uint64_t selected = 0;  ///< drawables of cut i that were selected; those under hidden scene nodes never are
  uint64_t tests = 0;     ///< boxes tested, those of inner scene nodes included
  uint64_t batches = 0;
  uint64_t hidden_subtrees = 0;  ///< inner scene nodes that one test found hidden
  uint64_t untested = 0;         ///< drawables that count as visible because their bounds are unknown

  /// Empties it and keeps its memory.
  void clear() {
    visible.clear();
    selected = tests = batches = hidden_subtrees = untested = 0;
  }
};

}  // namespace triptych
