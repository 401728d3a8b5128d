#include "measure/timeline_trace.hpp"

#include <algorithm>
#include <limits>

namespace triptych {

using nlohmann::json;

json chrome_trace(const std::vector<ProcessTimeline>& processes, const std::vector<PeerClock>& clocks) {
  const auto clock_of = [&](const ProcessTimeline& process) {
    const auto found = std::find_if(clocks.begin(), clocks.end(),
                                    [&](const PeerClock& clock) { return clock.peer == process.process; });
    return found == clocks.end() ? PeerClock{process.process, 0, 0} : *found;
  };
  double start_ms = std::numeric_limits<double>::infinity();
  for (const ProcessTimeline& process : processes) {
    const double ahead_ms = clock_of(process).ahead_ms;
    for (const StageSpan& span : process.spans) start_ms = std::min(start_ms, span.begin_ms - ahead_ms);
  }
  json events = json::array(), moved = json::array();
  int pid = 0;
  for (const ProcessTimeline& process : processes) {
    ++pid;
    const PeerClock clock = clock_of(process);
    events.push_back(
        {{"ph", "M"}, {"name", "process_name"}, {"pid", pid}, {"args", {{"name", process.process}}}});
    events.push_back(
        {{"ph", "M"}, {"name", "process_sort_index"}, {"pid", pid}, {"args", {{"sort_index", pid}}}});
    moved.push_back({{"process", process.process},
                     {"clock_ahead_ms", clock.ahead_ms},
                     {"uncertainty_ms", clock.uncertainty_ms},
                     {"spans_lost", process.lost}});
    for (const StageSpan& span : process.spans) {
      events.push_back({{"ph", "X"},
                        {"name", span.stage},
                        {"cat", "stage"},
                        {"pid", pid},
                        {"tid", 1},
                        {"ts", (span.begin_ms - clock.ahead_ms - start_ms) * 1000},
                        {"dur", (span.end_ms - span.begin_ms) * 1000},
                        {"args", {{"frame", span.frame}}}});
    }
  }
  return {{"traceEvents", events}, {"displayTimeUnit", "ms"}, {"otherData", {{"clocks", moved}}}};
}

}  // namespace triptych
