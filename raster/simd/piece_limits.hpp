// How far behind the limits of their pieces corners lie, a vector of triangles
// at a time: slack() in raster/triangle.cpp. Included once by the file of each
// instruction set.
#pragma once

#include "raster/simd/depth_planes.hpp"
#include "raster/simd/kernels.hpp"
#include "raster/simd/vector.hpp"

namespace triptych {
namespace {

/// DepthLimit, of each lane its own.
struct PieceLimits {
  Floats x[3], y[3], at[3], nearest;

  [[gnu::always_inline]] PieceLimits(const SetUpTerms& terms, Ints vertices) {
    Ints piece = {};
    for (int32_t i = 0; i < lanes; ++i) piece[i] = terms.pieces[vertices[i]];
    // Mostly all are of one piece.
    if (!any(piece != piece[0])) {
      const DepthLimit& limit = terms.limits[piece[0]];
      set(
          [&](const float* value) __attribute__((always_inline)) { return splat(*value); }, limit);
    } else {
      constexpr int32_t words = sizeof(DepthLimit) / sizeof(float);
      set(
          [&](const float* value) __attribute__((always_inline)) {
            return (Floats)gather(reinterpret_cast<const int32_t*>(value), piece * words);
          },
          terms.limits[0]);
    }
  }

  [[gnu::always_inline]] Floats least_slack(const Corners& a, const Corners& b, const Corners& c) const {
    return lesser(lesser(slack(a), slack(b)), slack(c));
  }

 private:
  [[gnu::always_inline]] Floats slack(const Corners& corner) const {
    constexpr float rounding_share = 4 * 0x1p-24f;
    const Floats to_x = to_float(corner.x) * (1.0f / 256), to_y = to_float(corner.y) * (1.0f / 256);
    Floats result = nearest - corner.depth;
    for (int i = 0; i < 3; ++i) {
      const Floats along_x = x[i] * to_x, along_y = y[i] * to_y;
      const Floats rounding =
          rounding_share * (magnitude(along_x) + magnitude(along_y) + magnitude(at[i]) + corner.depth);
      result = lesser(result, ((along_x + along_y) + at[i]) - corner.depth - rounding);
    }
    return result;
  }
  template <typename Take>
  [[gnu::always_inline]] void set(const Take& take, const DepthLimit& limit) {
    for (int i = 0; i < 3; ++i) {
      x[i] = take(limit.x + i);
      y[i] = take(limit.y + i);
      at[i] = take(limit.at + i);
    }
    nearest = take(&limit.nearest);
  }
};

}  // namespace
}  // namespace triptych
