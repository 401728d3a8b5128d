// Colours, once a pixel, when all is drawn.
#pragma once

#include "raster/triangle_shader.hpp"

#include <cstdint>
#include <span>

namespace triptych {

/// The picture of what the buffer holds under the view, rows from bottom to top: flat faces, or the colours
/// of corners over them, in the light that visibility/shading.hpp has, over the background.
void shade(const VisibilityBuffer& buffer, const FrameView& view, std::span<Rgba> picture);

/// The drawable that shows at each pixel, plus 1; 0 where none does.
void name_items(const VisibilityBuffer& buffer, std::span<uint32_t> items);

}  // namespace triptych
