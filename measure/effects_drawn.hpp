// Which effects took part in the frames of a run.
#pragma once

#include "nodes/frame_record.hpp"

#include <nlohmann/json.hpp>
#include <vector>

namespace triptych {

/// {name: {"frames", "ms", "draws", "fragments"}} for each effect that took part in any of them: how many it
/// took part in, and distributions over those. Empty where none did.
nlohmann::json effects_drawn(const std::vector<FrameRecord>& frames);

}  // namespace triptych
