// The digest by which receivers know that they hold the sender's visible set.
#pragma once

#include "scene/camera.hpp"
#include "visibility/visible_set.hpp"

#include <cstdint>

namespace triptych {

/// 64 bits over everything that makes a frame: its number, camera and viewport, pixel error (pixels), pack
/// and V(i).
uint64_t frame_digest(uint32_t frame, const View& view, double pixel_error, uint64_t pack_hash,
                      const VisibleSet& visible);

}  // namespace triptych
