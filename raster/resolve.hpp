// Pictures out of several samples a pixel, or with edges.
#pragma once

#include "raster/sample_planes.hpp"
#include "raster/shading_counts.hpp"
#include "raster/transparent_layers.hpp"

#include <span>

namespace triptych {

/// Of each pixel the mean of its samples' colours, in whole numbers, halves up: a triangle is shaded once for
/// all of them, at the pixel's centre where its colours vary. Where the frame state has edges, each sample
/// that the rule names is drawn as one, beside the same sample of its neighbours; what is transparent comes
/// over it. layers: of each plane those, or none. Rows from bottom to top.
void resolve(const SamplePlanes& planes, const FrameView& view, const TextureLevels& textures,
             std::span<const TransparentLayers> layers, std::span<Rgba> picture, ShadingCounts& counts);

}  // namespace triptych
