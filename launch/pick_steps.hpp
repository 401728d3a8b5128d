// What it costs to find what is under the cursor.
#pragma once

#include "scene/frame_state.hpp"
#include "scene/pack.hpp"

#include <array>
#include <span>
#include <vector>

namespace triptych {

inline constexpr std::array pick_step_names = {"pick", "snap"};

/// Microseconds of one frame's picks and of its snaps: the medians over places of the picture.
using PickSamples = std::array<double, pick_step_names.size()>;

/// For each frame at 5 x 5 places of the picture, with the whole cut as what is shown, chunks that were read
/// before.
std::vector<PickSamples> measure_picks(const Pack& pack, std::span<const FrameRequest> frames);

}  // namespace triptych
