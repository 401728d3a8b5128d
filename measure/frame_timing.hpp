// How single frames are timed side by side.
#pragma once

#include "scene/frame_state.hpp"
#include "visibility/frame_target.hpp"

namespace triptych {

/// Processor time of all threads of this process so far, milliseconds.
double process_cpu_milliseconds();

/// Lets the target's device begin another view, so that each of several that draw a frame in turn pays for
/// what a device computes once for a view and keeps.
void begin_other_view(FrameTarget& target, const Skeleton& skeleton, const FrameRequest& frame);

}  // namespace triptych
