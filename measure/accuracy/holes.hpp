// Background that shows through: what a bound on distance cannot see.
#pragma once

#include "measure/accuracy/patches.hpp"
#include "measure/accuracy/surface_pixels.hpp"

#include <span>

namespace triptych {

/// Background where the reference shows surfaces for `radius` pixels all round.
PixelMask find_holes(std::span<const SurfacePixel> reference, std::span<const SurfacePixel> shown, int width,
                     int height, int radius);

/// Takes those pixels out of the holes whose middle what is shown beside them comes as near to as 1/128 of a
/// pixel, and returns how many: surfaces that meet in corners on each other's edges are drawn with slits
/// about as narrow as a device snaps corners, the full detail's too. shown: of that view.
uint64_t take_out_slits(const PackSurfaces& surfaces, const FrameView& view,
                        std::span<const SurfacePixel> shown, PixelMask& holes);

}  // namespace triptych
