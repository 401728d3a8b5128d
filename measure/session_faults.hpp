// What went wrong in a session and when it had recovered, from its frame records.
#pragma once

#include "nodes/frame_record.hpp"

#include <nlohmann/json.hpp>
#include <vector>

namespace triptych {

/// The runs of frames that the render node drew by itself, in order: [{"frame" (the first of them),
/// "second" (of the session, when it was due), "reason", "frames_alone", "alone_ms", "back_at_frame" (null
/// where the switch nodes did not come back)}].
nlohmann::json faults_json(const std::vector<FrameRecord>& frames);

}  // namespace triptych
