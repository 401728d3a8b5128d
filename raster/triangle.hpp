// A triangle as it is filled: edge functions and depth.
#pragma once

#include "raster/fill_triangle.hpp"
#include "raster/window.hpp"
#include "visibility/depth_bound.hpp"
#include "visibility/layer_offset.hpp"
#include "visibility/pixel_sides.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace triptych {

/// What triangles of one picture are cut to.
struct PictureLimits {
  int width = 0, height = 0;
};

/// A triangle, what computing its depth at a pixel that it covers may be off by, and how its corners went
/// round.
struct WindowTriangle : FillTriangle {
  float error;
  bool clockwise;
};

/// Without its limit.
inline float depth_at(const FillTriangle& of, int32_t x, int32_t y) {
  const int32_t dx = x * subpixels + subpixels / 2 - of.first_x,
                dy = y * subpixels + subpixels / 2 - of.first_y;
  const float depth =
      of.precise ? static_cast<float>((double{of.z} + of.precise_y * dy) + of.precise_x * dx)
                 : (of.z + of.slope_y * static_cast<float>(dy)) + of.slope_x * static_cast<float>(dx);
  return depth < of.low ? of.low : depth > of.high ? of.high : depth;
}

/// Pixels whose centres lie in the box around a triangle, all inclusive.
struct PixelBox {
  int32_t left, right, bottom, top;
  bool empty() const { return left > right || bottom > top; }
};
inline PixelBox pixel_box(const std::array<WindowVertex, 3>& corners, const PictureLimits& limits) {
  constexpr int32_t half = subpixels / 2;
  const auto& [a, b, c] = corners;
  return {std::max((std::min({a.x, b.x, c.x}) + half - 1) >> subpixel_bits, 0),
          std::min((std::max({a.x, b.x, c.x}) - half) >> subpixel_bits, limits.width - 1),
          std::max((std::min({a.y, b.y, c.y}) + half - 1) >> subpixel_bits, 0),
          std::min((std::max({a.y, b.y, c.y}) - half) >> subpixel_bits, limits.height - 1)};
}

/// In sub-pixels; positive where the corners go round counter-clockwise.
inline int64_t twice_area(const std::array<WindowVertex, 3>& corners) {
  const auto& [a, b, c] = corners;
  return int64_t{b.x - a.x} * int64_t{c.y - a.y} - int64_t{c.x - a.x} * int64_t{b.y - a.y};
}

/// False where it covers nothing: it has no area, or lies between pixel centres. precisely: its depths are
/// computed in doubles.
bool set_up(const std::array<WindowVertex, 3>& corners, const PictureLimits& limits, WindowTriangle& triangle,
            bool precisely = false);

/// Moves it behind what lies on it.
void put_below(uint32_t layers, const LayerOffset& offset, WindowTriangle& triangle);

/// As it is at that sample of each pixel.
DepthLimit depth_limit(const PixelDepthBound& bound, const SamplePlace& place = {});
/// How far behind the limit a corner lies, at least, in depth; negative in front of it.
float slack(const DepthLimit& limit, const WindowVertex& corner);

/// The depth that the limit allows at the centre of a pixel.
inline float limit_at(const DepthLimit& limit, int32_t x, int32_t y) {
  const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
  float depth = limit.nearest;
  for (int i = 0; i < 3; ++i) {
    const float plane = (limit.x[i] * px + limit.y[i] * py) + limit.at[i];
    depth = plane < depth ? plane : depth;
  }
  return depth;
}

/// As it is over a picture.
SectionSidesOver sides_over(const PixelSides& sides);
/// Whether the sides in `cut` keep what is so deep at the centre of a pixel.
inline bool keeps(const SectionSidesOver& sides, uint32_t cut, int32_t x, int32_t y, float depth) {
  const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
  for (int i = 0; cut != 0; ++i, cut >>= 1) {
    const float along = (sides.x[i] * px + sides.y[i] * py) + sides.at[i];
    if ((cut & 1) != 0 && !(along + sides.of_depth[i] * depth >= 0)) return false;
  }
  return true;
}

/// As deep as the ray through the centre of a pixel comes into what all sides keep, at that side which it
/// passes last; beyond all depths where that is the near plane.
inline float entry_depth(const SectionSidesOver& sides, int32_t x, int32_t y) {
  const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
  float entry = 2;
  for (int i = 0; i < sides.count; ++i) {
    const float along = (sides.x[i] * px + sides.y[i] * py) + sides.at[i];
    if (!(along + sides.of_depth[i] < 0)) continue;
    const float depth = along / -sides.of_depth[i];
    entry = depth < entry ? depth : entry;
  }
  return entry;
}

}  // namespace triptych
