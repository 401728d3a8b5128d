#include "base/error.hpp"
#include "preprocess/textures/image.hpp"

#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <jpeglib.h>
#include <memory>
#include <png.h>
#include <webp/decode.h>

namespace triptych {

namespace {

constexpr uint64_t max_texels = uint64_t{1} << 28;

Image empty_image(uint64_t width, uint64_t height, const std::string& place) {
  if (width == 0 || height == 0 || width > max_texels || height > max_texels / width)
    fail(place, "has {}x{} texels", width, height);
  return {static_cast<uint32_t>(width), static_cast<uint32_t>(height),
          std::vector<Texel>(static_cast<size_t>(width * height))};
}

const uint8_t* data_of(std::span<const std::byte> bytes) {
  return reinterpret_cast<const uint8_t*>(bytes.data());
}

bool begins_with(std::span<const std::byte> bytes, std::string_view beginning, size_t at = 0) {
  return bytes.size() >= at + beginning.size() &&
         std::memcmp(bytes.data() + at, beginning.data(), beginning.size()) == 0;
}

Image decode_png(std::span<const std::byte> bytes, const std::string& place) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, decltype(&png_image_free)> owner(&header, png_image_free);
  if (png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()) == 0)
    fail(place, "is a damaged PNG file: {}", header.message);
  Image image = empty_image(header.width, header.height, place);
  header.format = PNG_FORMAT_RGBA;
  if (png_image_finish_read(&header, nullptr, image.texels.data(), 0, nullptr) == 0)
    fail(place, "is a damaged PNG file: {}", header.message);
  return image;
}

/// libjpeg reports errors by a function that does not return.
struct JpegErrors {
  jpeg_error_mgr manager{};
  std::jmp_buf after = {};
  char message[JMSG_LENGTH_MAX] = {};

  static void leave(j_common_ptr decoder) {
    auto* const errors = reinterpret_cast<JpegErrors*>(decoder->err);
    decoder->err->format_message(decoder, errors->message);
    std::longjmp(errors->after, 1);
  }
  static void ignore(j_common_ptr) {}
};

/// Nothing here has a destructor that the jump would pass over. False where the file is damaged.
bool read_jpeg(std::span<const std::byte> bytes, jpeg_decompress_struct& decoder, JpegErrors& errors,
               Image& image, const std::string& place) {
  if (setjmp(errors.after) != 0) return false;
  jpeg_create_decompress(&decoder);
  jpeg_mem_src(&decoder, data_of(bytes), bytes.size());
  jpeg_read_header(&decoder, TRUE);
  decoder.out_color_space = JCS_EXT_RGBA;
  jpeg_start_decompress(&decoder);
  image = empty_image(decoder.output_width, decoder.output_height, place);
  while (decoder.output_scanline < decoder.output_height) {
    JSAMPROW row =
        reinterpret_cast<JSAMPROW>(image.texels.data() + size_t{decoder.output_scanline} * image.width);
    jpeg_read_scanlines(&decoder, &row, 1);
  }
  jpeg_finish_decompress(&decoder);
  return true;
}

Image decode_jpeg(std::span<const std::byte> bytes, const std::string& place) {
  JpegErrors errors;
  jpeg_decompress_struct decoder{};
  decoder.err = jpeg_std_error(&errors.manager);
  errors.manager.error_exit = JpegErrors::leave;
  errors.manager.output_message = JpegErrors::ignore;
  const std::unique_ptr<jpeg_decompress_struct, decltype(&jpeg_destroy_decompress)> owner(
      &decoder, jpeg_destroy_decompress);
  Image image;
  if (!read_jpeg(bytes, decoder, errors, image, place))
    fail(place, "is a JPEG file that cannot be read: {}", errors.message);
  return image;
}

Image decode_webp(std::span<const std::byte> bytes, const std::string& place) {
  int width = 0, height = 0;
  if (WebPGetInfo(data_of(bytes), bytes.size(), &width, &height) == 0) fail(place, "is a damaged WebP file");
  Image image = empty_image(static_cast<uint64_t>(width), static_cast<uint64_t>(height), place);
  auto* const into = reinterpret_cast<uint8_t*>(image.texels.data());
  if (WebPDecodeRGBAInto(data_of(bytes), bytes.size(), into, image.texels.size() * sizeof(Texel),
                         width * static_cast<int>(sizeof(Texel))) == nullptr)
    fail(place, "is a damaged WebP file");
  return image;
}

/// What else it may well be; null where that is not known.
const char* other_format(std::span<const std::byte> bytes) {
  struct Known {
    std::string_view beginning;
    const char* format;
  };
  constexpr Known known[] = {{"\xabKTX 20\xbb", "KTX2"},
                             {"\xabKTX 11\xbb", "KTX"},
                             {"DDS ", "DDS"},
                             {"GIF8", "GIF"},
                             {"BM", "BMP"},
                             {"II*", "TIFF"},
                             {{"MM\0*", 4}, "TIFF"},
                             {"8BPS", "Photoshop"},
                             {"\x76\x2f\x31\x01", "OpenEXR"}};
  for (const auto& [beginning, format] : known)
    if (begins_with(bytes, beginning)) return format;
  // TGA has no mark of its own at its beginning: an image of true colour or grey, packed or not.
  if (bytes.size() > 18 && bytes[1] == std::byte{0}) {
    const auto kind = std::to_integer<int>(bytes[2]), depth = std::to_integer<int>(bytes[16]);
    if ((kind == 2 || kind == 3 || kind == 10 || kind == 11) &&
        (depth == 8 || depth == 16 || depth == 24 || depth == 32))
      return "TGA";
  }
  return nullptr;
}

}  // namespace

Image decode_image(std::span<const std::byte> bytes, const std::string& place) {
  if (begins_with(bytes, "\x89PNG")) return decode_png(bytes, place);
  if (begins_with(bytes, "\xff\xd8")) return decode_jpeg(bytes, place);
  if (begins_with(bytes, "RIFF") && begins_with(bytes, "WEBP", 8)) return decode_webp(bytes, place);
  if (bytes.empty()) fail(place, "is empty");
  if (const char* const format = other_format(bytes))
    fail(place, "is a {} file, which is not read: convert it to PNG, JPEG or WebP", format);
  fail(place, "is neither a PNG, a JPEG nor a WebP file");
}

}  // namespace triptych
