// Lines over a picture: boxes and frustums, for people.
#pragma once

#include "raster/shade.hpp"
#include "visibility/screen_lines.hpp"

#include <span>

namespace triptych {

/// One pixel wide, without a depth test, cut to the frustum; rows from bottom to top.
void draw_lines(std::span<const ScreenLine> lines, int width, int height, std::span<Rgba> picture);

}  // namespace triptych
