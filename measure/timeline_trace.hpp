// The stages of all processes of a run as one Chrome trace, which Perfetto and chrome://tracing open.
#pragma once

#include "measure/session_records.hpp"

#include <nlohmann/json.hpp>
#include <vector>

namespace triptych {

/// Spans become complete events, one process per role, on the first process's clock; microseconds from the
/// first span on. clocks: of the other processes against the first, by their names; a process without one
/// counts as having the same clock. By how much each clock was moved, and the uncertainty of that, is in
/// "otherData".
nlohmann::json chrome_trace(const std::vector<ProcessTimeline>& processes,
                            const std::vector<PeerClock>& clocks);

}  // namespace triptych
