// Which pixel error a frame gets so that it takes no longer than a target.
#pragma once

#include <functional>

namespace triptych {

/// Pixel errors are raised up to this one, or the asked one if that is larger: beyond it pictures do not show
/// what they are of.
inline constexpr double max_raised_pixel_error = 64;

/// A frame may take this much of its target and still counts as within it.
inline constexpr double target_tolerance = 1.2;

struct GovernedFrame {
  double pixel_error = 1;   ///< never below the asked one
  double predicted_ms = 0;  ///< at this pixel error
  bool in_reach = true;     ///< false: the prediction exceeds the target at the largest pixel error, too
};

/// Chooses pixel errors frame by frame, in steps of a quarter octave. What a frame may be predicted to take
/// is the target, or less where predictions turn out so uncertain that otherwise more than 5 % of the frames
/// would take longer than target_tolerance times the target. A frame that would take longer gets the smallest
/// pixel error with 95 % of that; one that would take at most 85 % of it with the next smaller one gets that:
/// between the two the pixel error stays, so that levels do not flap. Finer by one step a frame, coarser at
/// once.
class FrameGovernor {
 public:
  /// target_ms: above 0.
  explicit FrameGovernor(double target_ms) : target_ms_(target_ms) {}

  /// asked: the pixel error where there is time for it, above 0. predict: milliseconds that the frame will
  /// take at a pixel error; called a few times. What is not a number counts as longer than the target.
  GovernedFrame choose(double asked, const std::function<double(double pixel_error)>& predict);
  /// A frame took so many milliseconds. Ignored where either is not above 0, or not finite, and where less
  /// than half of the aim was predicted: such frames keep the target however uncertain they are.
  void learn(double predicted_ms, double milliseconds);

  double target_ms() const { return target_ms_; }
  /// What a frame may be predicted to take.
  double aim_ms() const;

 private:
  double target_ms_;
  int step_ = 0;  ///< quarter octaves above the asked pixel error
  /// An estimate of the 95th percentile of what frames took over what was predicted.
  double overrun_ = 1;
};

}  // namespace triptych
