// Wall-clock time. OpenGL's timer queries are wrong on software renderers, so stages are timed around
// glFinish.
#pragma once

#include <chrono>
#include <cmath>

namespace triptych {

/// This machine's steady clock: the same for all its processes, and without meaning on another machine.
inline double steady_milliseconds() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// Rounded to 2⁻¹⁰ milliseconds, about a microsecond: such a number ends in zeros, which need not be sent.
inline double to_the_microsecond(double milliseconds) { return std::round(milliseconds * 1024) / 1024; }

/// Runs from its construction or last restart.
class Stopwatch {
 public:
  double milliseconds() const {
    return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
  }
  double seconds() const { return milliseconds() / 1000; }
  void restart() { start_ = Clock::now(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace triptych
