#include "render/png_file.hpp"

#include "base/error.hpp"
#include "base/file.hpp"

#include <png.h>
#include <vector>

namespace triptych {

std::vector<std::byte> encode_png(int width, int height, std::span<const uint8_t> rgba,
                                  const std::string& place) {
  const auto row_bytes = static_cast<size_t>(width) * 3;
  std::vector<uint8_t> rgb(row_bytes * static_cast<size_t>(height));
  for (size_t pixel = 0; pixel < rgb.size() / 3; ++pixel) {
    for (size_t channel = 0; channel < 3; ++channel) rgb[pixel * 3 + channel] = rgba[pixel * 4 + channel];
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGB;
  image.flags = PNG_IMAGE_FLAG_FAST;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::vector<std::byte> bytes(size);
  const auto stride = -static_cast<png_int_32>(row_bytes);  // bottom row first
  if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, rgb.data(), stride, nullptr)) {
    fail(place, "cannot be encoded as PNG: {}", image.message);
  }
  bytes.resize(size);
  return bytes;
}

void write_png(const std::filesystem::path& file, int width, int height, std::span<const uint8_t> rgba) {
  const std::vector<std::byte> bytes = encode_png(width, height, rgba, file.string());
  AtomicFile output(file);
  output.write(bytes);
  output.commit();
}

}  // namespace triptych
