// Where one surface of the reference ends before another.
#pragma once

#include "measure/accuracy/patches.hpp"
#include "measure/accuracy/surface_pixels.hpp"

#include <span>

namespace triptych {

/// Without what is no further than `radius` pixels from an edge that the reference shows: from background, or
/// from where one surface ends before another, which is more than two pixels' width further back than the
/// first would go on to. There an outline that moved by as much shows what it hid.
PixelMask away_from_edges(const FrameView& view, std::span<const SurfacePixel> reference, PixelMask mask,
                          int radius);

}  // namespace triptych
