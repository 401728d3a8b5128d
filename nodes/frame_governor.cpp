#include "nodes/frame_governor.hpp"

#include <algorithm>
#include <cmath>

namespace triptych {

namespace {

constexpr double steps_per_octave = 4;
/// Of the aim: what is sought where it is exceeded, and what leads to a finer step.
constexpr double sought = 0.95, finer = 0.85;
/// Of frames that may exceed the tolerance; and how far one that does moves the estimate, as a logarithm.
constexpr double exceeding_share = 0.05, exceeding_step = 0.1;
constexpr double max_overrun = 2;
/// Of the aim: from which prediction on a frame tells how uncertain predictions are.
constexpr double relevant = 0.5;

}  // namespace

double FrameGovernor::aim_ms() const { return target_ms_ * std::min(1.0, target_tolerance / overrun_); }

/// Steps up where a frame exceeds the estimate, and down where it does not, by so much less that the two
/// balance at the percentile (Robbins and Monro 1951).
void FrameGovernor::learn(double predicted_ms, double milliseconds) {
  const double ratio = milliseconds / predicted_ms;
  if (!(predicted_ms >= relevant * aim_ms()) || !(ratio > 0) || !std::isfinite(ratio)) return;
  const double exceeds = ratio > overrun_ ? 1 : 0;
  overrun_ = std::clamp(overrun_ * std::exp(exceeding_step * (exceeds - exceeding_share)), 1.0, max_overrun);
}

GovernedFrame FrameGovernor::choose(double asked, const std::function<double(double pixel_error)>& predict) {
  const double limit = std::max(asked, max_raised_pixel_error), aim = aim_ms();
  const int last = static_cast<int>(std::ceil(steps_per_octave * std::log2(limit / asked)));
  const auto at = [&](int step) {
    const double pixel_error = std::min(limit, asked * std::exp2(step / steps_per_octave));
    return GovernedFrame{pixel_error, predict(pixel_error)};
  };
  const auto keeps = [&](const GovernedFrame& frame, double share) {
    return frame.predicted_ms <= share * aim;
  };
  step_ = std::clamp(step_, 0, last);
  GovernedFrame frame = at(step_);
  if (!keeps(frame, 1)) {
    int too_long = step_;  // the step sought lies above this one; the last one will do where there is none
    step_ = last;
    frame = at(last);
    while (too_long + 1 < step_ && keeps(frame, sought)) {
      const int middle = too_long + (step_ - too_long) / 2;
      const GovernedFrame candidate = at(middle);
      if (keeps(candidate, sought)) {
        step_ = middle;
        frame = candidate;
      } else {
        too_long = middle;
      }
    }
  } else if (step_ > 0) {
    const GovernedFrame candidate = at(step_ - 1);
    if (keeps(candidate, finer)) {
      --step_;
      frame = candidate;
    }
  }
  frame.in_reach = frame.predicted_ms <= target_ms_;
  return frame;
}

}  // namespace triptych
