#include "base/timeline.hpp"

#include "base/clock.hpp"

namespace triptych {

namespace {
thread_local bool started = false;
thread_local std::vector<TimelineSpan> spans;
thread_local uint64_t lost = 0;
constexpr size_t max_spans = 1'000'000;
}  // namespace

void start_timeline() { started = true; }
bool timeline_started() { return started; }
const std::vector<TimelineSpan>& timeline_spans() { return spans; }
uint64_t timeline_spans_lost() { return lost; }

TimelineScope::TimelineScope(const char* stage, uint32_t frame) : stage_(stage), frame_(frame) {
  if (started) begin_ms_ = steady_milliseconds();
}

TimelineScope::~TimelineScope() {
  if (begin_ms_ < 0) return;
  if (spans.size() < max_spans) {
    spans.push_back({stage_, frame_, begin_ms_, steady_milliseconds()});
  } else {
    ++lost;
  }
}

}  // namespace triptych
