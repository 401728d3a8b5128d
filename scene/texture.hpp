// Textures of a pack: images with all of their coarser levels, and where on them a corner of a triangle is.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// Where on a texture, in units of 1/65536 of its width and height, from its upper left corner to the right
/// and down; or none.
struct TextureCoordinates {
  static constexpr int32_t none = INT32_MIN;
  static constexpr int32_t unit = 1 << 16;
  int32_t u = none, v = none;
  bool operator==(const TextureCoordinates&) const = default;
};

inline bool is_on_texture(const TextureCoordinates& place) { return place.u != TextureCoordinates::none; }

/// In widths and heights of the texture; what is beyond 32,000 of them, or no number, is clamped.
TextureCoordinates texture_coordinates(double u, double v);

/// Of the corners of a triangle.
using CornerCoordinates = std::array<TextureCoordinates, 3>;

/// What is beyond a texture's edges.
enum class TextureWrap : uint8_t { repeat, mirrored_repeat, clamp };

/// How a texture is looked at.
struct TextureSampler {
  TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
  bool nearest = false;  ///< single texels show; otherwise what is between them is interpolated
  bool operator==(const TextureSampler&) const = default;
};

/// Red, green, blue as displayed (sRGB), and alpha.
using Texel = std::array<uint8_t, 4>;

/// One level of a texture, and where its texels lie in the pack.
struct TextureLevel {
  uint64_t offset = 0, size = 0;  ///< bytes, from the start of the section of texels
  uint64_t checksum = 0;          ///< XXH3-64 of those bytes
};

/// An image, and its coarser levels: each has half of the width and of the height of the one before it,
/// rounded down, at least 1; the last one has a single texel.
struct Texture {
  uint32_t width = 0, height = 0;
  std::vector<TextureLevel> levels;  ///< as many as texture_levels() says
};

inline constexpr uint32_t max_texture_side = 8192;

constexpr uint32_t texture_levels(uint32_t width, uint32_t height) {
  uint32_t levels = 1;
  for (uint32_t side = width > height ? width : height; side > 1; side /= 2) ++levels;
  return levels;
}
constexpr uint32_t side_at_level(uint32_t side, uint32_t level) {
  return side >> level > 0 ? side >> level : 1;
}

/// Reads back what encode_texels (preprocess/encode_texture.hpp) wrote: rows from top to bottom. Error
/// (place) for bytes that do not decode.
std::vector<Texel> decode_texels(std::span<const std::byte> bytes, uint32_t width, uint32_t height,
                                 const std::string& place);

}  // namespace triptych
