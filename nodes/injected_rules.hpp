// `--inject` at the seams of a frame: a fault takes one rule away.
#pragma once

#include "lod/frame_rules.hpp"

namespace triptych {

/// All rules but those that this process was told to break.
FrameRules injected_frame_rules();

}  // namespace triptych
