#include "session/pictures.hpp"

#include <fmt/core.h>

namespace triptych {

std::string picture_name(uint32_t frame) { return fmt::format("{:06}.png", frame); }

std::vector<uint8_t> item_colors(const std::vector<uint32_t>& items) {
  std::vector<uint8_t> rgba;
  rgba.reserve(items.size() * 4);
  for (const uint32_t item : items) {
    const uint32_t mixed = item * 0x9e3779b1u;  // odd: one to one on the low 24 bits
    for (int shift = 0; shift < 24; shift += 8) rgba.push_back(static_cast<uint8_t>(mixed >> shift));
    rgba.push_back(255);
  }
  return rgba;
}

}  // namespace triptych
