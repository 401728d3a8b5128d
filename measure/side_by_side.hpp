// Draws the same path from several packs, frame by frame in turn, so that other load on the machine affects
// all of them.
#pragma once

#include "measure/comparison.hpp"
#include "nodes/local_pipeline.hpp"

#include <span>
#include <vector>

namespace triptych {

struct SideBySideRun {
  std::vector<FrameRecord> frames;  ///< of all rounds in order
  Comparison comparison;            ///< of the first round with the un-culled picture
};

/// Draws each frame in one process from each pack, one pack after the other; the pack that comes first
/// changes from frame to frame. Every round starts anew, as if nothing had been drawn. Then compares. device:
/// a chosen one.
std::vector<SideBySideRun> run_side_by_side(std::span<const Pack* const> packs,
                                            const std::vector<FrameRequest>& requests,
                                            const DeviceOptions& device, size_t rounds);

}  // namespace triptych
