// Frames that several ways of drawing take in turn.
#pragma once

#include "scene/frame_state.hpp"
#include "visibility/frame_target.hpp"

namespace triptych {

/// Lets the target's device begin another view, so that each of several that draw a frame in turn pays for
/// what a device computes once for a view and keeps.
void begin_other_view(FrameTarget& target, const Skeleton& skeleton, const FrameRequest& frame);

}  // namespace triptych
