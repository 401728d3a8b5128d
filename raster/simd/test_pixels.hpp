// Box tests at the pixels of a small rectangle, a vector of them at a time. Included once by the file of each
// instruction set.
#pragma once

#include "raster/simd/kernels.hpp"
#include "raster/simd/vector.hpp"

namespace triptych {
namespace {

[[gnu::always_inline]] inline Floats depths_of(const uint32_t* words) { return (Floats)load(words); }
[[gnu::always_inline]] inline Floats depths_of(const uint64_t* words) {
  return (Floats)odd(load(words), load(words + lanes / 2));
}

[[gnu::always_inline]] inline Floats plane_at(const PlaneTerms& plane, const Floats& x, float y) {
  return plane.x * x + plane.y * y + plane.offset;
}

template <typename Word>
[[gnu::always_inline]] inline bool test(const BoxTerms& box, const Word* words, int32_t width,
                                        const PixelRectangle& pixels) {
  const int32_t first = pixels.left < width - lanes ? pixels.left : width - lanes;
  for (int32_t start = first; start <= pixels.right; start += lanes) {
    // Not beyond the end of a row; a pixel that is tested twice gives the same answer.
    const int32_t from = start < width - lanes ? start : width - lanes;
    const Ints column = lane_numbers + from;
    const Ints wanted = (column >= pixels.left) & (column <= pixels.right);
    const Floats x = (2.0f * to_float(column) + 1.0f) / box.width - 1.0f;
    for (int32_t row = pixels.bottom; row <= pixels.top; ++row) {
      const Floats there = depths_of(words + static_cast<int64_t>(row) * width + from);
      const float y = (2 * static_cast<float>(row) + 1) / box.height - 1;
      Floats depth = plane_at(box.planes[0], x, y);
      for (int i = 1; i < 4; ++i) {
        const Floats other = plane_at(box.planes[i], x, y);
        depth = select(other < depth, other, depth);
      }
      Ints passes = wanted & (box.strict ? depth > there : depth >= there) & (depth >= 0);
      if (!any(passes)) continue;
      for (int i = 0; i < 4; ++i) passes &= plane_at(box.cuts[i], x, y) >= 0;
      if (any(passes)) return true;
    }
  }
  return false;
}

bool test_depths(const BoxTerms& box, const uint32_t* words, int32_t width, const PixelRectangle& pixels) {
  return test(box, words, width, pixels);
}
bool test_words(const BoxTerms& box, const uint64_t* words, int32_t width, const PixelRectangle& pixels) {
  return test(box, words, width, pixels);
}

}  // namespace
}  // namespace triptych
