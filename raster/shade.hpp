// Colours, once a pixel, when all is drawn.
#pragma once

#include "raster/shading_counts.hpp"
#include "raster/transparent_layers.hpp"

#include <cstdint>
#include <span>

namespace triptych {

/// The picture of what the buffer holds under the view, rows from bottom to top: flat faces, or the colours
/// of corners or textures over them, in the light that visibility/shading.hpp has, over the background.
/// layers: what is transparent over the buffer, or none.
void shade(const VisibilityBuffer& buffer, const FrameView& view, const TextureLevels& textures,
           std::span<const TransparentLayers> layers, std::span<Rgba> picture, ShadingCounts& counts);

/// The drawable that shows at each pixel, plus 1; 0 where none does.
void name_items(const VisibilityBuffer& buffer, std::span<uint32_t> items);

}  // namespace triptych
