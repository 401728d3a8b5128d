// Names and colours of the pictures that commands write.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace triptych {

/// "000017.png".
std::string picture_name(uint32_t frame);

/// An item buffer (drawable id + 1, 0 where nothing is) as RGBA: the value itself, spread over red, green and
/// blue by a mapping that gives each id its own colour, and ids next to each other different ones.
std::vector<uint8_t> item_colors(const std::vector<uint32_t>& items);

}  // namespace triptych
