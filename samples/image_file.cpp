#include "samples/image_file.hpp"

#include "base/error.hpp"
#include "base/file.hpp"

#include <png.h>
#include <string_view>

namespace triptych {

void write_image_file(const std::filesystem::path& file, uint32_t width, uint32_t height,
                      std::span<const ImagePixel> pixels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = width;
  image.height = height;
  image.format = PNG_FORMAT_RGBA;
  png_alloc_size_t size = 0;
  std::vector<std::byte> bytes;
  bool written = png_image_write_to_memory(&image, nullptr, &size, 0, pixels.data(), 0, nullptr) != 0;
  bytes.resize(size);
  written =
      written && png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, nullptr) != 0;
  if (!written) fail(file.string(), "cannot be encoded: {}", image.message);
  bytes.resize(size);
  write_file(file, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

}  // namespace triptych
