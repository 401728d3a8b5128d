// Records when each stage of each frame ran in this process. Off by default; then it only costs the test of a
// flag.
#pragma once

#include <cstdint>
#include <vector>

namespace triptych {

/// A stage of a frame. Times are of the process's steady clock, milliseconds.
struct TimelineSpan {
  const char* stage = "";  ///< valid as long as the thread
  uint32_t frame = 0;
  double begin_ms = 0, end_ms = 0;
};

/// Records spans from now on: at most a million; further ones are only counted.
void start_timeline();
bool timeline_started();
/// The spans recorded so far, in the order of their ends.
const std::vector<TimelineSpan>& timeline_spans();
uint64_t timeline_spans_lost();

/// A span from its construction to its end. Only recorded in the thread that started the timeline.
class TimelineScope {
 public:
  TimelineScope(const char* stage, uint32_t frame);
  ~TimelineScope();
  TimelineScope(const TimelineScope&) = delete;
  TimelineScope& operator=(const TimelineScope&) = delete;

 private:
  const char* stage_;
  uint32_t frame_;
  double begin_ms_ = -1;
};

}  // namespace triptych
