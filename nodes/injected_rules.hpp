// `--inject` at the seams of a frame: a fault takes one rule away.
#pragma once

#include "lod/frame_rules.hpp"

namespace triptych {

/// All rules except those that the injected faults take away.
FrameRules injected_frame_rules();

}  // namespace triptych
