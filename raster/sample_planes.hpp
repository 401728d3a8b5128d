// One buffer for each sample of a picture's pixels.
#pragma once

#include "raster/visibility_buffer.hpp"

#include <deque>

namespace triptych {

/// Each is drawn like a picture of its own, whose pixel centres lie at that sample of each pixel: the grid of
/// sub-pixels is moved, and what a vertex is rounded to is the same in all of them. All draw the same
/// stretches in the same order. At least one.
using SamplePlanes = std::deque<VisibilityBuffer>;

/// Whether equal slots of two of them are the same triangle: as long as none has run out of numbers.
inline bool share_slots(const SamplePlanes& planes) {
  for (const VisibilityBuffer& plane : planes) {
    if (plane.is_renumbered()) return false;
  }
  return true;
}

}  // namespace triptych
