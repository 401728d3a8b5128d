#include "samples/building/image_average.hpp"

#include <array>
#include <cmath>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <jpeglib.h>
#include <png.h>
#include <vector>

namespace triptych {
namespace {

const std::array<double, 256>& linear_table() {
  static const auto table = [] {
    std::array<double, 256> values{};
    for (size_t i = 0; i < values.size(); ++i) values[i] = linear_from_srgb(static_cast<double>(i) / 255);
    return values;
  }();
  return table;
}

struct Mean {
  glm::dvec3 sum{0};
  double weight = 0;

  void add(const uint8_t* colour, double alpha) {
    const auto& linear = linear_table();
    sum += alpha * glm::dvec3(linear[colour[0]], linear[colour[1]], linear[colour[2]]);
    weight += alpha;
  }
  std::optional<glm::dvec3> value() const {
    if (weight <= 0) return std::nullopt;
    return sum / weight;
  }
};

std::optional<glm::dvec3> average_png(std::string_view bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&image, bytes.data(), bytes.size())) return std::nullopt;
  image.format = PNG_FORMAT_RGBA;
  constexpr uint64_t max_pixels = uint64_t{1} << 27;
  std::vector<uint8_t> pixels;
  if (uint64_t{image.width} * image.height > max_pixels) {
    png_image_free(&image);
    return std::nullopt;
  }
  pixels.resize(PNG_IMAGE_SIZE(image));
  if (!png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr)) return std::nullopt;
  Mean mean;
  for (size_t i = 0; i + 3 < pixels.size(); i += 4) mean.add(&pixels[i], pixels[i + 3] / 255.0);
  return mean.value();
}

struct JpegErrors {
  jpeg_error_mgr manager;
  std::jmp_buf jump;
};

// libjpeg reports errors by a jump; everything with a destructor lives in the caller.
bool decode_jpeg(std::string_view bytes, std::vector<uint8_t>& row, Mean& mean) {
  jpeg_decompress_struct decoder;
  JpegErrors errors;
  decoder.err = jpeg_std_error(&errors.manager);
  errors.manager.error_exit = [](j_common_ptr common) {
    std::longjmp(reinterpret_cast<JpegErrors*>(common->err)->jump, 1);
  };
  errors.manager.emit_message = [](j_common_ptr, int) {};
  if (setjmp(errors.jump)) {
    jpeg_destroy_decompress(&decoder);
    return false;
  }
  jpeg_create_decompress(&decoder);
  jpeg_mem_src(&decoder, reinterpret_cast<const unsigned char*>(bytes.data()),
               static_cast<unsigned long>(bytes.size()));
  jpeg_read_header(&decoder, TRUE);
  decoder.out_color_space = JCS_RGB;
  // An eighth of the size is decoded from the blocks' means alone, which is all that an average needs.
  decoder.scale_num = 1;
  decoder.scale_denom = 8;
  decoder.dct_method = JDCT_ISLOW;
  jpeg_start_decompress(&decoder);
  row.resize(size_t{decoder.output_width} * 3);
  while (decoder.output_scanline < decoder.output_height) {
    JSAMPROW rows[] = {row.data()};
    jpeg_read_scanlines(&decoder, rows, 1);
    for (size_t i = 0; i < row.size(); i += 3) mean.add(&row[i], 1);
  }
  jpeg_finish_decompress(&decoder);
  jpeg_destroy_decompress(&decoder);
  return true;
}

}  // namespace

double linear_from_srgb(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

std::optional<glm::dvec3> average_colour(std::string_view bytes) {
  if (bytes.substr(0, 4) == "\x89PNG") return average_png(bytes);
  if (bytes.substr(0, 2) != "\xff\xd8") return std::nullopt;
  std::vector<uint8_t> row;
  Mean mean;
  if (!decode_jpeg(bytes, row, mean)) return std::nullopt;
  return mean.value();
}

}  // namespace triptych
