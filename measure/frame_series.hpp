// A run frame by frame, for charts.
#pragma once

#include "nodes/frame_record.hpp"

#include <nlohmann/json.hpp>
#include <vector>

namespace triptych {

/// {"frame_ms", "cut", "visible", "changed", "drawn_triangles"}: arrays with one value per frame, in order;
/// times in milliseconds, rounded to microseconds; changed counts the ids that were added or removed.
nlohmann::json frame_series(const std::vector<FrameRecord>& frames);

}  // namespace triptych
