#include "preprocess/textures/image.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// As large as that, of the nearest texels.
Image enlarged(const Image& image, uint32_t width, uint32_t height) {
  Image large{width, height, {}};
  large.texels.reserve(size_t{width} * height);
  for (uint32_t y = 0; y < height; ++y) {
    const size_t row = uint64_t{y} * image.height / height;
    for (uint32_t x = 0; x < width; ++x)
      large.texels.push_back(image.texels[row * image.width + uint64_t{x} * image.width / width]);
  }
  return large;
}

/// Rec. 709, of what is displayed.
uint8_t brightness(const Texel& texel) {
  return static_cast<uint8_t>((2126u * texel[0] + 7152u * texel[1] + 722u * texel[2] + 5000u) / 10000u);
}

}  // namespace

void set_alpha(Image& image, const Image& alpha) {
  if (image.texels.empty())
    image = {alpha.width, alpha.height, std::vector<Texel>(alpha.texels.size(), Texel{255, 255, 255, 255})};
  const uint32_t width = std::max(image.width, alpha.width), height = std::max(image.height, alpha.height);
  const auto fits = [&](const Image& one) { return one.width == width && one.height == height; };
  if (!fits(image)) image = enlarged(image, width, height);
  const Image own = fits(alpha) ? Image() : enlarged(alpha, width, height);
  const std::vector<Texel>& says = fits(alpha) ? alpha.texels : own.texels;
  const bool by_brightness = std::ranges::all_of(says, [](const Texel& texel) { return texel[3] == 255; });
  for (size_t i = 0; i < says.size(); ++i)
    image.texels[i][3] = by_brightness ? brightness(says[i]) : says[i][3];
}

}  // namespace triptych
