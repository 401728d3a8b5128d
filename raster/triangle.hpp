// A triangle as it is filled: edge functions and depth.
#pragma once

#include "raster/window.hpp"
#include "visibility/depth_bound.hpp"

#include <array>
#include <cstdint>
#include <optional>

namespace triptych {

/// What triangles of one picture are cut to.
struct PictureLimits {
  int width = 0, height = 0;
};

/// How the depth of a triangle changes by a sub-pixel.
struct DepthSlopes {
  double x, y;
};

/// A triangle whose box holds at least one pixel centre of the picture. Pixel (left + i, bottom + j) is
/// covered where all of edge[k] + step_x[k] · i + step_y[k] · j ≥ 0; an edge's own pixels belong to it where
/// it is a left or a top one (y up). Its depth there is
///
///   clamp((z + slope_y · dy) + slope_x · dx, low, high),   dx, dy: sub-pixels from the first corner
///
/// in this order, in floats. Where those might be too coarse, as for slivers and for what the near plane
/// cuts, `precise` has the slopes, and the depth is computed, in doubles. Where it is not proven to keep the
/// bound of its piece, `bound` has that, and the farther of both counts.
struct WindowTriangle {
  std::array<int64_t, 3> edge;
  std::array<int32_t, 3> step_x, step_y;
  int32_t left, right, bottom, top;  ///< pixels, inclusive
  int32_t first_x, first_y;          ///< the first corner, sub-pixels
  float z, slope_x, slope_y;         ///< depth there, and what it changes by a sub-pixel
  float low, high;                   ///< the corners' depths
  float error;                       ///< what computing its depth at a pixel that it covers may be off by
  uint32_t slot = 0;
  std::optional<DepthSlopes> precise;
  const PixelDepthBound* bound = nullptr;

  float depth_at(int32_t x, int32_t y) const {
    const int32_t dx = x * subpixels + subpixels / 2 - first_x, dy = y * subpixels + subpixels / 2 - first_y;
    if (precise) return clamped(static_cast<float>((double{z} + precise->y * dy) + precise->x * dx));
    return clamped((z + slope_y * static_cast<float>(dy)) + slope_x * static_cast<float>(dx));
  }

 private:
  float clamped(float depth) const { return depth < low ? low : depth > high ? high : depth; }
};

/// False where it covers nothing: it has no area, or lies between pixel centres.
bool set_up(const std::array<WindowVertex, 3>& corners, const PictureLimits& limits,
            WindowTriangle& triangle);

/// How far behind the bound a corner lies, at least, in depth; negative in front of it.
float slack(const PixelDepthBound& bound, const WindowVertex& corner);

/// The depth that the bound allows at the centre of a pixel.
inline float bound_at(const PixelDepthBound& bound, int32_t x, int32_t y) {
  const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
  float depth = bound.at.w;
  for (int i = 0; i < 3; ++i) {
    const float plane = (bound.x[i] * px + bound.y[i] * py) + bound.at[i];
    depth = plane < depth ? plane : depth;
  }
  return depth;
}

}  // namespace triptych
