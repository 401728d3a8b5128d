// Colours as most formats give them: to be displayed as they are, in sRGB.
#pragma once

#include "scene/vertex_color.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace triptych {

/// From sRGB's curve (IEC 61966-2-1) to linear light, both 0 to 1.
inline double linear_from_display(double value) {
  value = std::clamp(value, 0.0, 1.0);
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// Linear light, 0 to 1, as sRGB's curve shows it, in a byte; what is beyond is clamped, and no number is 0.
inline uint8_t display_byte(double linear) {
  const double value = linear > 0 ? std::min(linear, 1.0) : 0.0;
  const double srgb = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
  return static_cast<uint8_t>(std::lround(srgb * 255));
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

/// A vertex's colour as displayed, from channels of 0 to 1; what is beyond is clamped. None if one is no
/// number.
inline VertexColor vertex_color(const glm::dvec3& display) {
  if (std::isnan(display.x + display.y + display.z)) return {};
  const auto byte = [](double value) {
    return static_cast<uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255));
  };
  return {byte(display.x), byte(display.y), byte(display.z), 255};
}

/// The same from linear light.
inline VertexColor vertex_color_of_linear(const glm::dvec3& linear) {
  if (std::isnan(linear.x + linear.y + linear.z)) return {};
  return {display_byte(linear.x), display_byte(linear.y), display_byte(linear.z), 255};
}

}  // namespace triptych
