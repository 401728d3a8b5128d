// From the images of a model to textures: what is decoded, how levels are made, and what is said of those
// that cannot be read.
#include "base/error.hpp"
#include "base/unnamed_file.hpp"
#include "preprocess/textures/image.hpp"
#include "preprocess/textures/make_textures.hpp"
#include "scene/linear_light.hpp"
#include "tests/support/images.hpp"

#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <jpeglib.h>
#include <webp/encode.h>

namespace triptych {
namespace {

using test::image_of;
using test::png_file;

Texel ramp(uint32_t x, uint32_t y) {
  return {static_cast<uint8_t>(40 + 8 * x), static_cast<uint8_t>(200 - 9 * y), 90, 255};
}

std::vector<std::byte> jpeg_file(uint32_t width, uint32_t height) {
  jpeg_compress_struct encoder{};
  jpeg_error_mgr errors;
  encoder.err = jpeg_std_error(&errors);
  jpeg_create_compress(&encoder);
  unsigned char* memory = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&encoder, &memory, &size);
  encoder.image_width = width;
  encoder.image_height = height;
  encoder.input_components = 4;
  encoder.in_color_space = JCS_EXT_RGBX;
  jpeg_set_defaults(&encoder);
  jpeg_set_quality(&encoder, 98, TRUE);
  jpeg_start_compress(&encoder, TRUE);
  for (uint32_t y = 0; y < height; ++y) {
    std::vector<Texel> row;
    for (uint32_t x = 0; x < width; ++x) row.push_back(ramp(x, y));
    JSAMPROW bytes = row.front().data();
    jpeg_write_scanlines(&encoder, &bytes, 1);
  }
  jpeg_finish_compress(&encoder);
  const auto* const begin = reinterpret_cast<const std::byte*>(memory);
  std::vector<std::byte> file(begin, begin + size);
  jpeg_destroy_compress(&encoder);
  free(memory);
  return file;
}

std::vector<std::byte> webp_file(uint32_t width, uint32_t height) {
  std::vector<Texel> texels;
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x) texels.push_back(ramp(x, y));
  uint8_t* memory = nullptr;
  const size_t size = WebPEncodeLosslessRGBA(texels.front().data(), static_cast<int>(width),
                                             static_cast<int>(height), static_cast<int>(4 * width), &memory);
  const auto* const begin = reinterpret_cast<const std::byte*>(memory);
  std::vector<std::byte> file(begin, begin + size);
  WebPFree(memory);
  return file;
}

TEST(DecodeImage, reads_png_jpeg_and_webp_by_what_they_hold) {
  constexpr uint32_t width = 16, height = 12;
  const std::pair<std::vector<std::byte>, int> files[] = {
      {png_file(width, height, ramp), 0}, {jpeg_file(width, height), 6}, {webp_file(width, height), 0}};
  for (const auto& [bytes, tolerance] : files) {
    const Image image = decode_image(bytes, "image");
    ASSERT_EQ(image.width, width);
    ASSERT_EQ(image.height, height);
    for (uint32_t y = 0; y < height; ++y) {
      for (uint32_t x = 0; x < width; ++x) {
        for (size_t k = 0; k < 4; ++k)
          EXPECT_NEAR(image.texels[y * width + x][k], ramp(x, y)[k], tolerance) << x << ' ' << y;
      }
    }
  }
}

TEST(DecodeImage, refuses_what_is_cut_short_and_what_is_no_image_with_its_place) {
  for (std::vector<std::byte> bytes : {png_file(16, 12, ramp), webp_file(16, 12)}) {
    bytes.resize(bytes.size() / 2);
    EXPECT_THROW(decode_image(bytes, "place"), Error);
  }
  std::vector<std::byte> jpeg = jpeg_file(16, 12);
  jpeg.resize(20);
  EXPECT_THROW(decode_image(jpeg, "place"), Error);
  try {
    decode_image(std::vector<std::byte>(8), "image 3 (wood.ktx2)");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "image 3 (wood.ktx2): is neither a PNG, a JPEG nor a WebP file");
  }
}

TEST(HalfOf, is_the_mean_in_linear_light_of_what_each_texel_covers) {
  const Image image{2, 2, {{0, 0, 0, 255}, {255, 255, 255, 255}, {255, 255, 255, 255}, {0, 0, 0, 255}}};
  const Image half = half_of(image);
  ASSERT_EQ(half.texels.size(), 1u);
  EXPECT_EQ(half.texels[0], (Texel{188, 188, 188, 255})) << "half of the light, not half of the number";
  const Image odd{3, 1, {{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}}};
  const Texel third = half_of(odd).texels.at(0);
  const LinearLight& light = LinearLight::table();
  for (size_t k = 0; k < 3; ++k) EXPECT_EQ(third[k], light.displayed(LinearLight::most / 3)) << k;
}

TEST(HalfOf, what_shows_in_no_texel_tints_none) {
  const Image image{2, 1, {{200, 30, 10, 255}, {0, 255, 0, 0}}};
  EXPECT_EQ(half_of(image).texels[0], (Texel{200, 30, 10, 128}));
}

TEST(KeepCovered, as_large_a_share_is_covered_as_in_the_finest_level) {
  Image finest{64, 64, {}};
  for (uint32_t y = 0; y < 64; ++y)
    for (uint32_t x = 0; x < 64; ++x)
      finest.texels.push_back({0, 0, 0, static_cast<uint8_t>(x % 8 < 2 || y % 8 < 2 ? 255 : 0)});
  const auto share = [](const Image& image) {
    size_t covered = 0;
    for (const Texel& texel : image.texels) covered += texel[3] >= 128;
    return static_cast<double>(covered) / static_cast<double>(image.texels.size());
  };
  Image level = finest;
  for (int i = 0; i < 4; ++i) level = half_of(level);
  Image kept = level;
  keep_covered(kept, finest, 128);
  EXPECT_NEAR(share(finest), 0.4375, 1e-9);
  EXPECT_LT(share(level), 0.1) << "without that the wires vanish";
  EXPECT_GE(share(kept), share(finest));
}

TEST(LinearLight, is_the_curve_of_srgb_and_back) {
  const LinearLight& light = LinearLight::table();
  for (int i = 0; i < 256; ++i) {
    const double value = i / 255.0;
    const double linear = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
    EXPECT_NEAR(light.of(static_cast<uint8_t>(i)), linear * 65535, 0.51) << i;
    EXPECT_EQ(light.displayed(light.of(static_cast<uint8_t>(i))), i);
  }
}

SpoolFile spool() { return {"textures", open_unnamed_file(testing::TempDir())}; }

TEST(MakeTextures, equal_images_become_one_and_those_that_cannot_be_read_are_said_with_their_names) {
  Model model;
  model.images = {image_of("a", png_file(5, 3, ramp)), image_of("b", png_file(5, 3, ramp)),
                  image_of("file.gltf: image 2 (gone.png)", {}), image_of("unused", {})};
  for (const uint32_t image : {0u, 1u, 2u}) model.materials.push_back({.texture = image});
  SpoolFile file = spool();
  const Textures made = make_textures(model, file);
  ASSERT_EQ(made.textures.size(), 1u);
  EXPECT_EQ(made.of_images[0].texture, 0u);
  EXPECT_EQ(made.of_images[1].texture, 0u);
  EXPECT_EQ(made.of_images[2].texture, no_id);
  EXPECT_EQ(made.of_images[3].texture, no_id);
  ASSERT_EQ(made.warnings.size(), 1u);
  EXPECT_EQ(made.warnings[0],
            "1 images cannot be read, and what they are on is drawn without, the first: "
            "file.gltf: image 2 (gone.png): is empty");
  const Texture& texture = made.textures[0];
  ASSERT_EQ(texture.levels.size(), 3u) << "5x3, 2x1, 1x1";
  const auto first =
      decode_texels(file.read({texture.levels[0].offset, texture.levels[0].size}), 5, 3, "level");
  for (uint32_t y = 0; y < 3; ++y)
    for (uint32_t x = 0; x < 5; ++x) EXPECT_EQ(first[y * 5 + x], ramp(x, y));
  EXPECT_NO_THROW(
      decode_texels(file.read({texture.levels[1].offset, texture.levels[1].size}), 2, 1, "level"));
}

TEST(MakeTextures, sides_beyond_the_most_are_halved_and_it_is_said) {
  Model model;
  model.images = {image_of("wide", png_file(2 * max_built_side, 2, [](uint32_t, uint32_t) -> Texel {
                             return {1, 2, 3, 255};
                           }))};
  model.materials.push_back({.texture = 0});
  SpoolFile file = spool();
  const Textures made = make_textures(model, file);
  ASSERT_EQ(made.textures.size(), 1u);
  EXPECT_EQ(made.textures[0].width, max_built_side);
  EXPECT_EQ(made.textures[0].height, 1u);
  EXPECT_EQ(made.warnings.size(), 1u);
}

TEST(Textures, take_their_alpha_from_another_image_of_any_size) {
  const auto of = [](uint32_t width, uint32_t height, Texel texel) {
    return Image{width, height, std::vector<Texel>(size_t{width} * height, texel)};
  };
  Image image = of(2, 2, {10, 20, 30, 255});
  Image mask = of(4, 1, {0, 0, 0, 255});
  mask.texels[3] = {255, 255, 255, 255};
  set_alpha(image, mask);
  ASSERT_EQ(image.width, 4u);
  ASSERT_EQ(image.height, 2u);
  EXPECT_EQ(image.texels[0], (Texel{10, 20, 30, 0})) << "its brightness";
  EXPECT_EQ(image.texels[7], (Texel{10, 20, 30, 255}));
  mask.texels[0][3] = 7;
  set_alpha(image, mask);
  EXPECT_EQ(image.texels[0][3], 7) << "its own alpha, where it has any";
  EXPECT_EQ(image.texels[3][3], 255);
  Image none;
  set_alpha(none, mask);
  EXPECT_EQ(none.texels[0], (Texel{255, 255, 255, 7}));
}

TEST(Textures, of_formats_that_are_not_read_are_said_by_their_name_with_the_remedy) {
  const auto message = [](std::string_view bytes) -> std::string {
    try {
      decode_image(std::as_bytes(std::span(bytes)), "oak");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message(std::string_view("\xabKTX 20\xbb\r\n\x1a\n", 12)),
            "oak: is a KTX2 file, which is not read: convert it to PNG, JPEG or WebP");
  EXPECT_NE(message("DDS |").find("is a DDS file"), std::string::npos);
  EXPECT_NE(message("BM1234").find("is a BMP file"), std::string::npos);
  const std::string tga("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x18\0\1\2\3", 21);
  EXPECT_NE(message(tga).find("is a TGA file"), std::string::npos);
  EXPECT_EQ(message("what is this?"), "oak: is neither a PNG, a JPEG nor a WebP file");
}

}  // namespace
}  // namespace triptych
