// What changes from frame to frame that should not.
#pragma once

#include <cstdint>
#include <span>

namespace triptych {

/// Popping: how much more pixels change from one frame to the next than the reference's change there or at a
/// neighbour; the mean over pixels of the largest channel's change beyond that, of 255. All pictures: width ×
/// height × RGBA bytes.
double popping(std::span<const uint8_t> reference_before, std::span<const uint8_t> reference,
               std::span<const uint8_t> shown_before, std::span<const uint8_t> shown, int width, int height);

/// Flicker, as of surfaces in one plane: pixels that change far and back again within three successive
/// frames.
uint64_t flickering_pixels(std::span<const uint8_t> first, std::span<const uint8_t> second,
                           std::span<const uint8_t> third);

}  // namespace triptych
