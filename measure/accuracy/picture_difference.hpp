// How two pictures of one view differ in their colours.
#pragma once

#include <cstdint>
#include <span>

namespace triptych {

struct PictureDifference {
  uint64_t wrong_pixels = 0;  ///< that differ at all
  double squared_error = 0;   ///< sum over pixels and the three channels, of 255
  double ssim = 1;            ///< mean structural similarity of brightness; 1 for equal pictures
};

/// Both: width × height × RGBA bytes; alpha is ignored.
PictureDifference picture_difference(std::span<const uint8_t> reference, std::span<const uint8_t> shown,
                                     int width, int height);

/// The mean structural similarity (Wang, Bovik, Sheikh and Simoncelli, Image quality assessment, IEEE
/// Transactions on Image Processing 2004): windows of 11 × 11 pixels weighted by a Gaussian of 1.5, on
/// brightness (Rec. 601). Windows at the border are cut, and weigh what is left of them.
double structural_similarity(std::span<const uint8_t> one, std::span<const uint8_t> other, int width,
                             int height);

}  // namespace triptych
