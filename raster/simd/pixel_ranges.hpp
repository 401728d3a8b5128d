// Pixels between corners, a vector of triangles at a time. Included once by the
// file of each instruction set.
#pragma once

#include "raster/simd/vector.hpp"

namespace triptych {
namespace {

[[gnu::always_inline]] inline Ints least(Ints a, Ints b, Ints c) {
  const Ints ab = a < b ? a : b;
  return ab < c ? ab : c;
}
[[gnu::always_inline]] inline Ints most(Ints a, Ints b, Ints c) {
  const Ints ab = a > b ? a : b;
  return ab > c ? ab : c;
}

/// Pixels whose centres lie between (pixel_box() in raster/triangle.hpp).
struct PixelRanges {
  Ints first, last;
  [[gnu::always_inline]] PixelRanges(Ints low, Ints high, int32_t size)
      : first((low + 127) >> 8), last((high - 128) >> 8) {
    first = first > 0 ? first : Ints{};
    last = last < size ? last : splat(size - 1);
  }
  [[gnu::always_inline]] Ints hold_some() const { return first <= last; }
};

}  // namespace
}  // namespace triptych
