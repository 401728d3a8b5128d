// The baked light of a vertex: an attribute of its own beside the position, where a build was asked for it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace triptych {

/// Irradiance in red, green and blue, and how open the hemisphere is: bytes, as irradiance_byte() and
/// openness_byte() have them. All zero where the vertex has no baked light: openness is 1 or more elsewhere.
using VertexLight = std::array<uint8_t, 4>;

/// Of the corners of a triangle.
using CornerLight = std::array<VertexLight, 3>;

inline bool has_light(const VertexLight& light) { return light[3] != 0; }

/// The most irradiance that is told apart, in units of that under which a white surface shows as white.
inline constexpr float most_irradiance = 4;

/// Square roots, so that steps are nearly as fine as those of colours as displayed: of white 0.0157.
inline uint8_t irradiance_byte(float irradiance) {
  return static_cast<uint8_t>(
      std::lround(255 * std::sqrt(std::clamp(irradiance / most_irradiance, 0.0f, 1.0f))));
}
inline float irradiance_of(uint8_t byte) {
  const float root = static_cast<float>(byte) / 255;
  return most_irradiance * (root * root);
}

/// From 0, where nothing but near surfaces is seen, to 1.
inline uint8_t openness_byte(float openness) {
  return static_cast<uint8_t>(1 + std::lround(254 * std::clamp(openness, 0.0f, 1.0f)));
}
inline float openness_of(uint8_t byte) { return (static_cast<float>(byte) - 1) / 254; }

}  // namespace triptych
