// How much lighter or darker surfaces are than in the reference, as where facets of coarse levels show.
#pragma once

#include "measure/accuracy/patches.hpp"
#include "measure/accuracy/surface_pixels.hpp"

#include <array>
#include <cstdint>
#include <span>

namespace triptych {

/// Pixels by their difference: of the channel that differs most, 0 to 255.
class ShadeDifferences {
 public:
  void add(uint8_t difference) { ++counts_[difference]; }
  void add(const ShadeDifferences& other);
  uint64_t pixels() const;
  double mean() const;  ///< 0 without pixels
  /// The least difference that no more than a hundredth of the pixels exceed.
  int p99() const;

 private:
  std::array<uint64_t, 256> counts_{};
};

/// Of pixels inside smooth surfaces: the reference shows one base colour there and at the four neighbours, in
/// shades that differ by no more than 4 of 255, and the picture shows that base colour, too. colors: width ×
/// height × RGBA bytes.
ShadeDifferences shade_differences(std::span<const SurfacePixel> reference,
                                   std::span<const uint8_t> reference_colors,
                                   std::span<const SurfacePixel> shown, std::span<const uint8_t> shown_colors,
                                   int width, int height);

/// The same of the pixels of the mask, smooth or not, that the picture shows in the reference's base colour.
ShadeDifferences shade_differences_in(const PixelMask& mask, std::span<const SurfacePixel> reference,
                                      std::span<const uint8_t> reference_colors,
                                      std::span<const SurfacePixel> shown,
                                      std::span<const uint8_t> shown_colors);

/// Pixels where the reference shows one base colour, there and at the four neighbours.
PixelMask inside_surfaces(std::span<const SurfacePixel> reference, int width, int height);

}  // namespace triptych
