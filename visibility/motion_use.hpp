// What moving instances took part in a frame, and what evaluating them took.
#pragma once

#include "lod/frame_view.hpp"
#include "visibility/effect_use.hpp"

#include <vector>

namespace triptych {

/// Counts from its making: the poses of a time may be those of a frame before.
class MotionWatch {
 public:
  MotionWatch() = default;
  explicit MotionWatch(const FrameView& view) : poses_(moving_in(view)) {
    if (!poses_) return;
    steps_ = poses_->steps();
    ms_ = poses_->milliseconds();
  }
  /// Adds the effect where something was asked for that moves.
  void add_to(std::vector<EffectUse>& uses) const {
    if (!poses_ || poses_->steps() == 0) return;
    uses.push_back({.effect = Effect::motion,
                    .ms = poses_->milliseconds() - ms_,
                    .simulation_steps = poses_->steps() - steps_});
  }

 private:
  /// Without the effect nothing moves, wherever it is put.
  static std::shared_ptr<const Poses> moving_in(const FrameView& view) {
    return view.state.effects.has(Effect::motion) ? view.poses : nullptr;
  }
  std::shared_ptr<const Poses> poses_;
  uint64_t steps_ = 0;
  double ms_ = 0;
};

}  // namespace triptych
