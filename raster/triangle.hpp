// A triangle as it is filled: edge functions and depth.
#pragma once

#include "raster/fill_triangle.hpp"
#include "raster/window.hpp"
#include "visibility/depth_bound.hpp"
#include "visibility/layer_offset.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace triptych {

/// What triangles of one picture are cut to.
struct PictureLimits {
  int width = 0, height = 0;
};

/// A triangle, and what computing its depth at a pixel that it covers may be off by.
struct WindowTriangle : FillTriangle {
  float error;

  /// Without its limit.
  float depth_at(int32_t x, int32_t y) const {
    const int32_t dx = x * subpixels + subpixels / 2 - first_x, dy = y * subpixels + subpixels / 2 - first_y;
    if (precise) return clamped(static_cast<float>((double{z} + precise_y * dy) + precise_x * dx));
    return clamped((z + slope_y * static_cast<float>(dy)) + slope_x * static_cast<float>(dx));
  }

 private:
  float clamped(float depth) const { return depth < low ? low : depth > high ? high : depth; }
};

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

}  // namespace triptych
