// PNG images that samples draw themselves.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace triptych {

/// Red, green, blue as displayed, and alpha.
using ImagePixel = std::array<uint8_t, 4>;

/// Rows from top to bottom, width · height pixels. Error (file) if it cannot be written.
void write_image_file(const std::filesystem::path& file, uint32_t width, uint32_t height,
                      std::span<const ImagePixel> pixels);

/// of(x, y): a pixel, from the upper left corner.
template <typename OfPixel>
void write_image_file(const std::filesystem::path& file, uint32_t width, uint32_t height, const OfPixel& of) {
  std::vector<ImagePixel> pixels;
  pixels.reserve(size_t{width} * height);
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x) pixels.push_back(of(x, y));
  write_image_file(file, width, height, std::span<const ImagePixel>(pixels));
}

}  // namespace triptych
