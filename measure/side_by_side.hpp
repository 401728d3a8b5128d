// The same path over several packs, frame by frame in turn, so that what else the machine does hits all of
// them.
#pragma once

#include "measure/comparison.hpp"
#include "nodes/local_pipeline.hpp"

#include <span>
#include <vector>

namespace triptych {

struct SideBySideRun {
  std::vector<FrameRecord> frames;  ///< of all rounds, the first one's first
  Comparison comparison;            ///< of the first round with the un-culled picture
};

/// Draws each frame in one process from each pack, one pack after the other; frame by frame another one
/// begins. Every round starts over, as if nothing had been drawn. Then compares. device: a chosen one.
std::vector<SideBySideRun> run_side_by_side(std::span<const Pack* const> packs,
                                            const std::vector<FrameRequest>& requests,
                                            const DeviceOptions& device, size_t rounds);

}  // namespace triptych
