// The digest by which receivers check that they hold the sender's visible set.
#pragma once

#include "scene/frame_state.hpp"
#include "visibility/visible_set.hpp"

#include <cstdint>

namespace triptych {

/// 64 bits over everything that determines a frame: its number and state, the pack and V(i).
uint64_t frame_digest(uint32_t frame, const FrameState& state, uint64_t pack_hash, const VisibleSet& visible);

}  // namespace triptych
