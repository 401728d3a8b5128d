#include "tests/support/images.hpp"

#include <png.h>
#include <stdexcept>

namespace triptych::test {

std::vector<std::byte> png_file(uint32_t width, uint32_t height,
                                const std::function<Texel(uint32_t x, uint32_t y)>& of) {
  std::vector<Texel> texels;
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x) texels.push_back(of(x, y));
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = width;
  image.height = height;
  image.format = PNG_FORMAT_RGBA;
  png_alloc_size_t size = 0;
  if (png_image_write_to_memory(&image, nullptr, &size, 0, texels.data(), 0, nullptr) == 0)
    throw std::runtime_error(image.message);
  std::vector<std::byte> bytes(size);
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, texels.data(), 0, nullptr) == 0)
    throw std::runtime_error(image.message);
  bytes.resize(size);
  return bytes;
}

ModelImage image_of(std::string place, std::vector<std::byte> bytes) {
  return {std::move(place), [bytes = std::move(bytes)] { return bytes; }};
}

}  // namespace triptych::test
