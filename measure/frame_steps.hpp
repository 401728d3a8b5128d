// Measures what each step of a frame costs without drawing.
#pragma once

#include "lod/hierarchy.hpp"
#include "measure/answer_log.hpp"
#include "scene/frame_state.hpp"
#include "scene/pack.hpp"
#include "visibility/device.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace triptych {

/// The steps of a frame in their order, those of all three roles, and the reference selection of the whole
/// cut, which is not part of a frame.
enum class FrameStep {
  frame_view,
  representation,
  hardware_cull,
  encode_delta,
  receive_delta,
  digest,
  order,
  draw_list,
  select_cut
};
inline constexpr std::array frame_step_names = {"frame_view",   "representation", "hardware_cull",
                                                "encode_delta", "receive_delta",  "digest",
                                                "order",        "draw_list",      "select_cut"};

struct FrameStepSample {
  double microseconds = 0;   ///< the median of the rounds
  uint64_t allocations = 0;  ///< in the last round
};

/// Of one frame, by FrameStep.
using FrameStepSamples = std::array<FrameStepSample, frame_step_names.size()>;

/// Runs the frames once on the device, then `rounds` times with its recorded answers, without drawing. All
/// frames have one size. Frame 0 of each round is incoherent.
std::vector<FrameStepSamples> measure_frame_steps(const Pack& pack, const Hierarchy& hierarchy,
                                                  Device& device, const std::vector<FrameRequest>& frames,
                                                  size_t rounds);

}  // namespace triptych
