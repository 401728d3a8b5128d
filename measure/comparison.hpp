// Compares frames with the un-culled picture of the same cut, and with what is visible by the item buffer.
#pragma once

#include "nodes/device_choice.hpp"
#include "nodes/frame_record.hpp"
#include "scene/frame_state.hpp"
#include "scene/pack.hpp"

#include <vector>

namespace triptych {

struct Comparison {
  uint64_t frames_compared = 0;
  uint64_t identical_frames = 0;
  /// Σ over frames of drawables that own at least one pixel of the un-culled picture.
  uint64_t visible_drawables = 0;
  uint64_t drawn_drawables = 0;  ///< Σ |V(i)|
  /// Σ of visible drawables that are not in V(i); anything but 0 is a fault in culling.
  uint64_t missing_drawables = 0;
  std::vector<uint32_t> different;  ///< the numbers of frames that are not identical

  /// Drawn over visible, in drawables; 0 where nothing is visible.
  double culling_efficiency() const;
};

/// Draws each frame's whole cut, picture and item buffer in one pass, and compares with the picture hashes
/// and visible sets of several runs; one comparison per run. device: a chosen one, the same as drew
/// the frames. requests[k] is frame run[k] of each run.
std::vector<Comparison> compare(const Pack& pack, const DeviceOptions& device,
                                const std::vector<FrameRequest>& requests,
                                const std::vector<const std::vector<FrameRecord>*>& runs);

}  // namespace triptych
