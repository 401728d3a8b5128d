// What a bound on distance cannot see: background that shows through, and what lay hidden and comes through.
#pragma once

#include "measure/accuracy/patches.hpp"
#include "measure/accuracy/surface_pixels.hpp"

#include <span>

namespace triptych {

/// How far around a pixel the reference is looked at, pixels: what deviates by the pixel error may have moved
/// an outline by that much, and rasterisation by one more.
int search_radius(double pixel_error);

/// Background where the reference shows surfaces for `radius` pixels all round.
PixelMask find_holes(std::span<const SurfacePixel> reference, std::span<const SurfacePixel> shown, int width,
                     int height, int radius);

/// Takes those pixels out of the holes whose middle what is shown beside them comes as near to as 1/128 of a
/// pixel, and returns how many: surfaces that meet in corners on each other's edges are drawn with slits
/// about as narrow as a device snaps corners, the full detail's too. shown: of that view.
uint64_t take_out_slits(const PackSurfaces& surfaces, const FrameView& view,
                        std::span<const SurfacePixel> shown, PixelMask& holes);

/// Surfaces of which the reference shows nothing within `radius` pixels: no leaf that the drawable stands for
/// in about the same base colour. What a drawable of many objects shows of one of them in place of another
/// of the same colour is not seen.
PixelMask find_swaps(const Skeleton& skeleton, std::span<const SurfacePixel> reference,
                     std::span<const SurfacePixel> shown, int width, int height, int radius);

/// Without what is no further than `radius` pixels from an edge that the reference shows: from background, or
/// from where one surface ends before another, which is more than two pixels' width further back than the
/// first would go on to. There an outline that moved by as much shows what it hid.
PixelMask away_from_edges(const FrameView& view, std::span<const SurfacePixel> reference, PixelMask mask,
                          int radius);

}  // namespace triptych
