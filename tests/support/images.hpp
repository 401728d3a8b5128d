// Small images as the files that models name.
#pragma once

#include "model/model.hpp"
#include "scene/texture.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace triptych::test {

/// A PNG file with alpha; of(x, y): of a texel, from the upper left corner.
std::vector<std::byte> png_file(uint32_t width, uint32_t height,
                                const std::function<Texel(uint32_t x, uint32_t y)>& of);

/// An image of a model that is such a file.
ModelImage image_of(std::string place, std::vector<std::byte> bytes);

}  // namespace triptych::test
