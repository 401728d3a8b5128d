// The depths of a triangle along a row. Included once by the file of each
// instruction set.
#pragma once

#include "raster/fill_triangle.hpp"
#include "raster/simd/vector.hpp"

namespace triptych {
namespace {

/// Sub-pixels.
[[gnu::always_inline]] inline int32_t centre(int32_t pixel) { return pixel * 256 + 128; }

[[gnu::always_inline]] inline Floats clamped(const FillTriangle& triangle, Floats depth) {
  const Floats low = splat(triangle.low), high = splat(triangle.high);
  return select(depth < low, low, select(depth > high, high, depth));
}

/// plain: neither precise nor limited nor cut.
template <bool plain>
class RowDepth {
 public:
  [[gnu::always_inline]] explicit RowDepth(const FillTriangle& triangle)
      : triangle_(triangle),
        slope_(splat(triangle.slope_x)),
        low_(splat(triangle.low)),
        high_(splat(triangle.high)),
        to_first_(128 - triangle.first_x) {}

  [[gnu::always_inline]] void go_to(int32_t y) {
    const int32_t dy = centre(y) - triangle_.first_y;
    start_ = triangle_.z + triangle_.slope_y * static_cast<float>(dy);
    if (plain) return;
    y_ = y;
    precise_start_ = double{triangle_.z} + triangle_.precise_y * dy;
  }

  /// The bits of the depths of some columns of that row; 0, which is nothing,
  /// where a section keeps none.
  [[gnu::always_inline]] Ints at(Ints column) const {
    const Ints dx = column * 256 + to_first_;
    Floats depth = !plain && triangle_.precise ? precise(dx) : start_ + slope_ * to_float(dx);
    depth = select(depth < low_, low_, select(depth > high_, high_, depth));
    if (plain) return bits_of(depth);
    const Floats x = to_float(column) + 0.5f;
    if (triangle_.limit != nullptr) {
      const Floats limit = limit_of(*triangle_.limit, x);
      depth = select(limit < depth, limit, depth);
    }
    if (triangle_.sides == nullptr) return bits_of(depth);
    return bits_of(depth) & kept(*triangle_.sides, x, depth);
  }

 private:
  [[gnu::always_inline]] Floats precise(Ints dx) const {
    return to_float(precise_start_ + triangle_.precise_x * half(dx, false),
                    precise_start_ + triangle_.precise_x * half(dx, true));
  }
  [[gnu::always_inline]] Ints kept(const SectionSidesOver& sides, Floats x, Floats depth) const {
    const float y = static_cast<float>(y_) + 0.5f;
    Ints kept = splat(-1);
    for (uint32_t cut = triangle_.cut; cut != 0; cut &= cut - 1) {
      const int i = __builtin_ctz(cut);
      const Floats along = (sides.x[i] * x + sides.y[i] * y) + sides.at[i];
      kept &= (Ints)(along + sides.of_depth[i] * depth >= 0);
    }
    return kept;
  }
  [[gnu::always_inline]] Floats limit_of(const DepthLimit& limit, Floats x) const {
    const float y = static_cast<float>(y_) + 0.5f;
    Floats depth = splat(limit.nearest);
    for (int i = 0; i < 3; ++i) {
      const Floats plane = (limit.x[i] * x + limit.y[i] * y) + limit.at[i];
      depth = select(plane < depth, plane, depth);
    }
    return depth;
  }

  const FillTriangle& triangle_;
  Floats slope_, low_, high_;
  int32_t to_first_, y_ = 0;
  float start_ = 0;
  double precise_start_ = 0;
};

}  // namespace
}  // namespace triptych
