// What it costs to find what is under the cursor.
#pragma once

#include "nodes/device_choice.hpp"
#include "scene/frame_state.hpp"
#include "scene/pack.hpp"

#include <array>
#include <span>
#include <vector>

namespace triptych {

inline constexpr std::array pick_step_names = {"pick", "snap"};

/// Microseconds of one frame's slowest pick and snap, over places of the picture.
using PickSamples = std::array<double, pick_step_names.size()>;

/// For each frame at 5 x 5 places of the picture, chunks that were read before. At least one frame.
std::vector<PickSamples> measure_picks(const Pack& pack, std::span<const FrameRequest> frames,
                                       const DeviceOptions& device);

}  // namespace triptych
