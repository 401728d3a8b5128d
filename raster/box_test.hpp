// Where a box may show, tested against a buffer's depth at every pixel that the box may reach.
#pragma once

#include "raster/visibility_buffer.hpp"
#include "visibility/screen_bounds.hpp"

#include <cstdint>

namespace triptych {

/// At the centres of how many pixels the rectangle is at or in front of the depth (strictly in front of it,
/// where `strict`): exact, up to rounding of the rectangle's own planes, which their margins cover. Counting
/// ends at `enough`, at least 1, which is also the most that it gives.
uint32_t count_pixels(const VisibilityBuffer& buffer, const ScreenRectangle& rectangle, bool strict,
                      uint32_t enough);
/// Whether the farthest depths of tiles alone show that everything within these sides, this deep or deeper,
/// is hidden.
bool hides(const VisibilityBuffer& buffer, const ScreenExtent& sides, bool strict);

}  // namespace triptych
