// From the images of a model to the textures of a pack.
#pragma once

#include "base/spool_file.hpp"
#include "model/model.hpp"
#include "scene/texture.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace triptych {

/// Of an image of the model.
struct ImageTexture {
  uint32_t texture = no_id;   ///< no_id where it cannot be read, or no material names it
  uint8_t least_alpha = 255;  ///< of its texels
};

struct Textures {
  std::vector<ImageTexture> of_images;
  std::vector<Texture> textures;      ///< their levels lie in the file, in this order
  std::vector<std::string> warnings;  ///< of images that cannot be read, or are made smaller
};

/// Sides of more texels are halved.
inline constexpr uint32_t max_built_side = 4096;

/// Decodes the images that materials name, each with all of its levels; those that are equal, byte by byte,
/// become one. The same for any number of threads.
Textures make_textures(const Model& model, SpoolFile& file);

}  // namespace triptych
