// The time at which a window shows what moves.
#pragma once

#include "base/clock.hpp"

#include <string>

namespace triptych {

/// Runs like a clock, or stands. It may be read as often as one likes: a frame asks once.
class MotionClock {
 public:
  /// Stands at so many seconds.
  explicit MotionClock(double seconds) : at_(seconds) {}

  bool runs() const { return runs_; }
  double seconds() const { return runs_ ? at_ + since_.seconds() : at_; }
  /// Runs on from where it stood, or stands where it is.
  void toggle() {
    at_ = seconds();
    since_.restart();
    runs_ = !runs_;
  }
  /// Goes on from there.
  void set(double seconds) {
    at_ = seconds;
    since_.restart();
  }

 private:
  double at_;
  bool runs_ = false;
  Stopwatch since_;
};

}  // namespace triptych
