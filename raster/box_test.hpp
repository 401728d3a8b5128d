// Whether a box may show, tested against a buffer's depth at every pixel that the box may reach.
#pragma once

#include "raster/visibility_buffer.hpp"
#include "visibility/screen_bounds.hpp"

namespace triptych {

/// Whether the rectangle is at or in front of the depth (strictly in front of it, where `strict`) at the
/// centre of some pixel: exact, up to rounding of the rectangle's own planes, which their margins cover.
bool may_show(const VisibilityBuffer& buffer, const ScreenRectangle& rectangle, bool strict);
/// Whether the farthest depths of tiles alone show that everything within these sides, this deep or deeper,
/// is hidden.
bool hides(const VisibilityBuffer& buffer, const ScreenExtent& sides, bool strict);

}  // namespace triptych
