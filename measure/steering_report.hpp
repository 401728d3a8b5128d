// How well a run kept its target of time a frame.
#pragma once

#include "nodes/frame_steering.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace triptych {

/// {"megapixels" …}: milliseconds for one of each.
nlohmann::json coefficients_json(const CostCoefficients& coefficients);

/// Adds the keys of docs/using.md for --target-ms: `target_ms`, `pixel_error`, `steering`, and in `series`
/// `pixel_error`, `aim_ms`, `cost_ms` and `predicted_ms`. frames: those that were steered count, the others
/// are left out. measure: what their cost is. Returns a summary of one line, for people.
std::string add_steering(nlohmann::json& report, const std::vector<FrameRecord>& frames, double target_ms,
                         const std::string& measure, const CostCoefficients& coefficients);
/// The same of frames that this process steered.
std::string add_steering(nlohmann::json& report, const std::vector<FrameRecord>& frames,
                         const FrameSteering& steering);

}  // namespace triptych
