// The visible sets that a peer may still request.
#pragma once

#include "visibility/visible_set.hpp"

#include <cstdint>
#include <utility>

namespace triptych {

/// V(i) of the last frame that a switch node knows, and V(i−1). Both are empty before the first frame.
class RecentSets {
 public:
  void add(uint32_t frame, VisibleSet visible) {
    previous_ = std::exchange(latest_, std::move(visible));
    frame_ = frame;
  }
  const VisibleSet& latest() const { return latest_; }
  /// Null for any other frame.
  const VisibleSet* of(uint32_t frame) const {
    if (frame == frame_) return &latest_;
    return frame + 1 == frame_ ? &previous_ : nullptr;
  }

 private:
  VisibleSet latest_, previous_;
  uint32_t frame_ = 0;
};

}  // namespace triptych
