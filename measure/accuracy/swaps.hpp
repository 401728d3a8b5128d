// What lay hidden and comes through: what a bound on distance cannot see.
#pragma once

#include "measure/accuracy/finer_reference.hpp"
#include "measure/accuracy/patches.hpp"
#include "measure/accuracy/surface_pixels.hpp"

#include <span>

namespace triptych {

/// How far around a pixel the reference is looked at, pixels: what deviates by the pixel error may have moved
/// an outline by that much, and rasterisation by one more.
int search_radius(double pixel_error);

/// Surfaces of which the reference shows nothing within `radius` pixels: no leaf that the drawable stands for
/// in about the same base colour. What a drawable of many objects shows of one of them in place of another
/// of the same colour is not seen.
PixelMask find_swaps(const Skeleton& skeleton, std::span<const SurfacePixel> reference,
                     std::span<const SurfacePixel> shown, int width, int height, int radius);

/// Takes those pixels out of the swaps of which the full detail shows, between the middles of pixels, what
/// they show: what is thinner than a pixel shows in one picture and falls between the pixels of another.
/// Returns how many. finer: of the reference's view.
uint64_t take_out_thin(const PackSurfaces& surfaces, FinerReference& finer,
                       std::span<const SurfacePixel> shown, PixelMask& swaps, int radius);

}  // namespace triptych
