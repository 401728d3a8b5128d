// Wall-clock time. OpenGL's timer queries lie on software renderers, so stages are timed around glFinish.
#pragma once

#include <chrono>

namespace triptych {

/// Runs from its construction or last restart.
class Stopwatch {
 public:
  double milliseconds() const { return std::chrono::duration<double, std::milli>(Clock::now() - start_).count(); }
  double seconds() const { return milliseconds() / 1000; }
  void restart() { start_ = Clock::now(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace triptych
