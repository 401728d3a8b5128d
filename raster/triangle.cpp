#include "raster/triangle.hpp"

#include <algorithm>
#include <cmath>

namespace triptych {

namespace {

constexpr int32_t half = subpixels / 2;

/// What one operation in floats is off by, of its result.
constexpr float unit_roundoff = 0x1p-24f;

float as_float(int64_t value) { return static_cast<float>(value); }

/// The depth's slopes, and by how much it may be off. Set-up rounds a slope by five units of the sum of its
/// terms, evaluation the products and sums by three more, and the first corner's depth by two; twice that is
/// allowed, for terms of second order.
void set_up_depth(const std::array<WindowVertex, 3>& corners, int64_t area, WindowTriangle& triangle) {
  const auto& [a, b, c] = corners;
  const float dx1 = as_float(b.x - a.x), dx2 = as_float(c.x - a.x), dy1 = as_float(b.y - a.y),
              dy2 = as_float(c.y - a.y);
  const float dz1 = b.depth - a.depth, dz2 = c.depth - a.depth, whole = as_float(area);
  triangle.first_x = a.x;
  triangle.first_y = a.y;
  triangle.z = a.depth;
  triangle.slope_x = (dz1 * dy2 - dz2 * dy1) / whole;
  triangle.slope_y = (dz2 * dx1 - dz1 * dx2) / whole;
  triangle.low = std::min({a.depth, b.depth, c.depth});
  triangle.high = std::max({a.depth, b.depth, c.depth});
  const float terms_x = (std::abs(dz1 * dy2) + std::abs(dz2 * dy1)) / std::abs(whole),
              terms_y = (std::abs(dz2 * dx1) + std::abs(dz1 * dx2)) / std::abs(whole);
  const float reach_x = std::max(std::abs(dx1), std::abs(dx2)),
              reach_y = std::max(std::abs(dy1), std::abs(dy2));
  triangle.error = 2 * unit_roundoff * (8 * (terms_x * reach_x + terms_y * reach_y) + 2 * triangle.high);
}

/// To the left of it the edge function is positive. Minus one where its own pixels are not its triangle's.
/// Divided by a pixel's sub-pixels, which keeps the sign at pixel centres.
void set_up_edge(const WindowVertex& from, const WindowVertex& to, size_t edge, WindowTriangle& triangle) {
  const int32_t step_x = from.y - to.y, step_y = to.x - from.x;
  const bool own = step_x > 0 || (step_x == 0 && step_y < 0);
  const int64_t at = int64_t{step_y} * (triangle.bottom * subpixels + half - from.y) +
                     int64_t{step_x} * (triangle.left * subpixels + half - from.x) - (own ? 0 : 1);
  triangle.edge[edge] = at >> subpixel_bits;
  triangle.step_x[edge] = step_x;
  triangle.step_y[edge] = step_y;
}

}  // namespace

bool set_up(const std::array<WindowVertex, 3>& corners, const PictureLimits& limits,
            WindowTriangle& triangle) {
  const auto& [a, b, c] = corners;
  triangle.left = std::max((std::min({a.x, b.x, c.x}) + half - 1) >> subpixel_bits, 0);
  triangle.right = std::min((std::max({a.x, b.x, c.x}) - half) >> subpixel_bits, limits.width - 1);
  if (triangle.left > triangle.right) return false;
  triangle.bottom = std::max((std::min({a.y, b.y, c.y}) + half - 1) >> subpixel_bits, 0);
  triangle.top = std::min((std::max({a.y, b.y, c.y}) - half) >> subpixel_bits, limits.height - 1);
  if (triangle.bottom > triangle.top) return false;
  const int64_t area = int64_t{b.x - a.x} * int64_t{c.y - a.y} - int64_t{c.x - a.x} * int64_t{b.y - a.y};
  if (area == 0) return false;
  // Both sides show; counter-clockwise, the edge functions are positive inside.
  const WindowVertex &second = area > 0 ? b : c, &third = area > 0 ? c : b;
  set_up_edge(a, second, 0, triangle);
  set_up_edge(second, third, 1, triangle);
  set_up_edge(third, a, 2, triangle);
  set_up_depth(corners, area, triangle);
  return true;
}

float slack(const PixelDepthBound& bound, const WindowVertex& corner) {
  const float x = static_cast<float>(corner.x) / subpixels, y = static_cast<float>(corner.y) / subpixels;
  float least = bound.at.w - corner.depth;
  for (int i = 0; i < 3; ++i) {
    const float along_x = bound.x[i] * x, along_y = bound.y[i] * y;
    const float rounding =
        4 * unit_roundoff * (std::abs(along_x) + std::abs(along_y) + std::abs(bound.at[i]) + corner.depth);
    const float behind = ((along_x + along_y) + bound.at[i]) - corner.depth - rounding;
    least = behind < least ? behind : least;
  }
  return least;
}

}  // namespace triptych
