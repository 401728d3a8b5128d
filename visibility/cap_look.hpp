// What cut surfaces look like: their material's colour, darker, and hatched, as in drawings. One definition
// for every device.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace triptych {

/// A cut surface has its material's colour times this.
inline constexpr float cap_tone = 0.62f;

/// Its strokes have that colour times `scale` plus `add`, channel by channel: dark ones on what is bright,
/// bright ones on what is dark.
struct CapInk {
  float scale, add;
};
inline constexpr CapInk dark_ink{0.42f, 0}, bright_ink{1, 0.3f};
/// Of a material with a luminance below this, strokes are bright.
inline constexpr float dark_material = 0.22f;
inline constexpr float luminance_of_red = 0.299f, luminance_of_green = 0.587f, luminance_of_blue = 0.114f;

/// base: the material's colour from 0 to 1, not lit.
inline CapInk cap_ink(const glm::vec3& base) {
  const float luminance =
      (luminance_of_red * base.x + luminance_of_green * base.y) + luminance_of_blue * base.z;
  return luminance < dark_material ? bright_ink : dark_ink;
}

/// Strokes at 45 degrees that stay where they are on the screen, over a picture of that height in pixels:
/// wider, and further from each other, in larger ones. Those of neighbouring sides of a section cross.
class CapHatching {
 public:
  /// From one stroke to the next, in strokes' widths, along a row of pixels.
  static constexpr int32_t period = 8;

  explicit CapHatching(int32_t picture_height) : width_(std::clamp((picture_height + 225) / 450, 1, 4)) {}

  /// Along a row, pixels.
  int32_t stroke_width() const { return width_; }
  /// Whether there is a stroke at a pixel, counted from the picture's lower left corner, on the cap of the
  /// side of that number.
  bool inked(int32_t x, int32_t y, uint32_t side) const {
    const int32_t pitch = period * width_;
    // What is added keeps it positive, for pictures of up to 2^16 rows.
    const int32_t along = side % 2 == 0 ? x + y : x - y + (pitch << 16);
    return along % pitch < width_;
  }

 private:
  int32_t width_;
};

}  // namespace triptych
