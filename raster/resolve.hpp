// Pictures out of several samples a pixel, or with edges.
#pragma once

#include "raster/sample_planes.hpp"
#include "raster/triangle_shader.hpp"

#include <span>

namespace triptych {

/// Of each pixel the mean of its samples' colours, in whole numbers, halves up: a triangle is shaded once for
/// all of them, at the pixel's centre where its colours vary. Where the frame state has edges, each sample
/// that the rule names is drawn as one, beside the same sample of its neighbours. Rows from bottom to top.
void resolve(const SamplePlanes& planes, const FrameView& view, std::span<Rgba> picture);

}  // namespace triptych
