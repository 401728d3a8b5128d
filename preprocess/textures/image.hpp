// Images in memory, and what makes smaller ones of them.
#pragma once

#include "scene/texture.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace triptych {

struct Image {
  uint32_t width = 0, height = 0;
  std::vector<Texel> texels;  ///< rows from top to bottom
};

/// A PNG, JPEG or WebP file, whatever it is called. Error (place) for another one, for one that is damaged,
/// and for one of more than 2^28 texels.
Image decode_image(std::span<const std::byte> bytes, const std::string& place);

/// Gives the image the alpha that another one says: its own or, where that is 1 all over, its brightness. As
/// wide and high as the larger of the two; of the smaller one the nearest texels count. An image
/// without texels is white.
void set_alpha(Image& image, const Image& alpha);

/// Half as wide and as high, rounded down, at least 1: each texel is the mean of the area that it stands for,
/// in linear light, weighted by how much is covered there.
Image half_of(const Image& image);

/// Scales alpha, so that as large a share of the texels has at least `cutoff` as in the other image
/// (Castaño, Computing alpha mipmaps, 2010): what is cut out stays as dense in the distance.
void keep_covered(Image& image, const Image& of, uint8_t cutoff);

/// As packs hold them (scene/texture.hpp).
std::vector<std::byte> encode_texels(const Image& image);

}  // namespace triptych
