#include "raster/triangle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace triptych {

namespace {

constexpr int32_t half = subpixels / 2;

/// Where floats may be off by more, of the depth, depths are computed in doubles: half of what bounds allow.
constexpr float max_float_error = static_cast<float>(share_of_depth / 2);

/// What one operation is off by, of its result.
template <typename Number>
constexpr Number unit_roundoff = std::numeric_limits<Number>::epsilon() / 2;

template <typename Number>
struct DepthPlaneOf {
  Number slope_x, slope_y;
  Number error;  ///< what computing a depth from them may be off by
};

/// Set-up rounds a slope by five units of the sum of its terms, evaluation the products and sums by three
/// more, and the first corner's depth by two; twice that is allowed, for terms of second order.
template <typename Number>
DepthPlaneOf<Number> depth_plane(const std::array<WindowVertex, 3>& corners) {
  const auto& [a, b, c] = corners;
  const auto number = [](auto value) { return static_cast<Number>(value); };
  const Number dx1 = number(b.x - a.x), dx2 = number(c.x - a.x), dy1 = number(b.y - a.y),
               dy2 = number(c.y - a.y);
  const Number dz1 = number(b.depth) - number(a.depth), dz2 = number(c.depth) - number(a.depth),
               area = number(twice_area(corners));
  const Number terms_x = (std::abs(dz1 * dy2) + std::abs(dz2 * dy1)) / std::abs(area),
               terms_y = (std::abs(dz2 * dx1) + std::abs(dz1 * dx2)) / std::abs(area);
  const Number reach_x = std::max(std::abs(dx1), std::abs(dx2)),
               reach_y = std::max(std::abs(dy1), std::abs(dy2));
  const Number high = number(std::max({a.depth, b.depth, c.depth}));
  return {(dz1 * dy2 - dz2 * dy1) / area, (dz2 * dx1 - dz1 * dx2) / area,
          2 * unit_roundoff<Number> * (8 * (terms_x * reach_x + terms_y * reach_y) + 2 * high)};
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

bool set_up(const std::array<WindowVertex, 3>& corners, const PictureLimits& limits, WindowTriangle& triangle,
            bool precisely) {
  const auto& [a, b, c] = corners;
  const PixelBox box = pixel_box(corners, limits);
  if (box.empty()) return false;
  triangle.left = box.left;
  triangle.right = box.right;
  triangle.bottom = box.bottom;
  triangle.top = box.top;
  const int64_t area = twice_area(corners);
  if (area == 0) return false;
  // Both sides show; counter-clockwise, the edge functions are positive inside.
  const WindowVertex &second = area > 0 ? b : c, &third = area > 0 ? c : b;
  set_up_edge(a, second, 0, triangle);
  set_up_edge(second, third, 1, triangle);
  set_up_edge(third, a, 2, triangle);
  const DepthPlaneOf<float> plane = depth_plane<float>(corners);
  triangle.precise = false;
  triangle.precise_x = triangle.precise_y = 0;
  triangle.limit = nullptr;
  triangle.sides = nullptr;
  triangle.cut = 0;
  triangle.clockwise = area < 0;
  triangle.slot = 0;
  triangle.first_x = a.x;
  triangle.first_y = a.y;
  triangle.z = a.depth;
  triangle.slope_x = plane.slope_x;
  triangle.slope_y = plane.slope_y;
  triangle.error = plane.error;
  triangle.low = std::min({a.depth, b.depth, c.depth});
  triangle.high = std::max({a.depth, b.depth, c.depth});
  if (precisely || !(triangle.error <= max_float_error * triangle.low)) {
    const DepthPlaneOf<double> precise = depth_plane<double>(corners);
    triangle.precise = true;
    triangle.precise_x = precise.slope_x;
    triangle.precise_y = precise.slope_y;
    triangle.error = static_cast<float>(precise.error) + 2 * unit_roundoff<float> * triangle.high;
  }
  return true;
}

void put_below(uint32_t layers, const LayerOffset& offset, WindowTriangle& triangle) {
  const float x = triangle.precise ? static_cast<float>(triangle.precise_x) : triangle.slope_x,
              y = triangle.precise ? static_cast<float>(triangle.precise_y) : triangle.slope_y;
  const float to_axis_x = offset.axis_x * subpixels - static_cast<float>(triangle.first_x),
              to_axis_y = offset.axis_y * subpixels - static_cast<float>(triangle.first_y);
  const DepthDrop below =
      offset.drop(layers, {x * subpixels, y * subpixels, (triangle.z + y * to_axis_y) + x * to_axis_x});
  triangle.z = triangle.z * below.keep - below.drop;
  triangle.slope_x *= below.keep;
  triangle.slope_y *= below.keep;
  triangle.precise_x *= below.keep;
  triangle.precise_y *= below.keep;
  triangle.low = below.apply(triangle.low);
  triangle.high = below.apply(triangle.high);
  // What was rounded here: the slopes, and the first corner's depth.
  triangle.error = triangle.error * 1.5f + 4 * unit_roundoff<float> * (triangle.high + below.drop);
}

DepthLimit depth_limit(const PixelDepthBound& bound, const SamplePlace& place) {
  const glm::vec2 offset(place.pixels());
  DepthLimit limit;
  for (int i = 0; i < 3; ++i) {
    limit.x[i] = bound.x[i];
    limit.y[i] = bound.y[i];
    limit.at[i] = bound.at[i] + (bound.x[i] * offset.x + bound.y[i] * offset.y);
  }
  limit.nearest = bound.at.w;
  return limit;
}

SectionSidesOver sides_over(const PixelSides& sides) {
  static_assert(SectionSidesOver::max == Section::max_sides);
  SectionSidesOver over{};
  over.count = static_cast<int32_t>(sides.all().size());
  for (size_t i = 0; i < sides.all().size(); ++i) {
    const PixelSide& side = sides.all()[i];
    over.x[i] = side.x;
    over.y[i] = side.y;
    over.at[i] = side.at;
    over.of_depth[i] = side.of_depth;
  }
  return over;
}

float slack(const DepthLimit& limit, const WindowVertex& corner) {
  const float x = static_cast<float>(corner.x) / subpixels, y = static_cast<float>(corner.y) / subpixels;
  float least = limit.nearest - corner.depth;
  for (int i = 0; i < 3; ++i) {
    const float along_x = limit.x[i] * x, along_y = limit.y[i] * y;
    const float rounding = 4 * unit_roundoff<float> *
                           (std::abs(along_x) + std::abs(along_y) + std::abs(limit.at[i]) + corner.depth);
    const float behind = ((along_x + along_y) + limit.at[i]) - corner.depth - rounding;
    least = behind < least ? behind : least;
  }
  return least;
}

}  // namespace triptych
