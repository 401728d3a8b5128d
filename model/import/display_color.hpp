// Colours as most formats give them: to be displayed as they are, in sRGB.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec4.hpp>

namespace triptych {

/// From sRGB's curve (IEC 61966-2-1) to linear light, both 0 to 1.
inline double linear_from_display(double value) {
  value = std::clamp(value, 0.0, 1.0);
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// An opaque base colour of a material, from channels of 0 to 1.
inline glm::vec4 from_display_color(double red, double green, double blue) {
  return {static_cast<float>(linear_from_display(red)), static_cast<float>(linear_from_display(green)),
          static_cast<float>(linear_from_display(blue)), 1};
}

/// The same from 0xRRGGBB.
inline glm::vec4 from_display_color(uint32_t rgb) {
  return from_display_color((rgb >> 16 & 255) / 255.0, (rgb >> 8 & 255) / 255.0, (rgb & 255) / 255.0);
}

}  // namespace triptych
