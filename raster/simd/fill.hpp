// Filling triangles by the way that suits their size. Included once by the file of each instruction set.
#pragma once

#include "raster/simd/fill_wide.hpp"

namespace triptych {
namespace {

/// Whether no edge function exceeds 32 bits at the pixels of its rows and `lanes` columns on either side.
[[gnu::always_inline]] inline bool is_small(const FillTriangle& triangle) {
  constexpr int64_t limit = 1 << 28;
  const int64_t rows = triangle.top - triangle.bottom;
  bool small = true;
  for (int k = 0; k < 3; ++k) {
    const int64_t edge = triangle.edge[k], across = int64_t{triangle.step_x[k]} * lanes,
                  up = triangle.step_y[k] * rows;
    small &= edge < limit && edge > -limit && across < limit && across > -limit && up < limit && up > -limit;
  }
  return small;
}

/// Whether the tiles at its pixels hide it; marks them where not.
[[gnu::always_inline]] inline bool is_hidden(const FillTriangle& triangle, int32_t bottom, int32_t top,
                                             const FillTarget& target) {
  const int32_t first = triangle.left / tile, last = triangle.right / tile;
  bool hidden = true;
  for (int32_t y = bottom / tile; hidden && y <= top / tile; ++y) {
    const float* const tiles = target.tiles + int64_t{y} * target.columns;
    for (int32_t x = first; x <= last; ++x) hidden &= triangle.high < tiles[x];
  }
  if (hidden) return true;
  for (int32_t y = bottom / tile; y <= top / tile; ++y) {
    uint8_t* const marked = target.marked + int64_t{y} * target.columns;
    for (int32_t x = first; x <= last; ++x) marked[x] = 1;
  }
  return false;
}

/// No wider than a vector: every pixel of a row at once.
template <bool plain>
[[gnu::always_inline]] inline void fill_narrow(const FillTriangle& triangle, int32_t bottom, int32_t top,
                                               Pixels& pixels) {
  const int32_t x = triangle.left, stride = pixels.target().stride;
  const Ints columns = lane_numbers + x;
  Ints edge[3];
  for (int k = 0; k < 3; ++k) {
    edge[k] = lane_numbers * triangle.step_x[k] +
              (static_cast<int32_t>(triangle.edge[k]) + triangle.step_y[k] * (bottom - triangle.bottom));
  }
  RowDepth<plain> depth(triangle);
  for (int32_t y = bottom; y <= top; ++y) {
    const Ints covered = (edge[0] | edge[1] | edge[2]) >= 0;
    depth.go_to(y);
    pixels.write(int64_t{y} * stride + x, covered, depth.at(columns));
    for (int k = 0; k < 3; ++k) edge[k] += triangle.step_y[k];
  }
}

template <bool plain>
[[gnu::always_inline]] inline void fill_any(const FillTriangle& triangle, int32_t bottom, int32_t top,
                                            const FillTarget& target) {
  Pixels pixels(target, triangle.slot);
  if (triangle.right - triangle.left < lanes && is_small(triangle)) {
    if (!is_hidden(triangle, bottom, top, target)) fill_narrow<plain>(triangle, bottom, top, pixels);
  } else {
    fill_wide<plain>(triangle, bottom, top, pixels);
  }
}

void fill(const FillTriangle& triangle, int32_t first_row, int32_t last_row, const FillTarget& target) {
  const int32_t bottom = greater(triangle.bottom, first_row), top = lesser(triangle.top, last_row);
  if (bottom > top) return;
  if (!triangle.precise && triangle.limit == nullptr && triangle.sides == nullptr) {
    fill_any<true>(triangle, bottom, top, target);
  } else {
    fill_any<false>(triangle, bottom, top, target);
  }
}

}  // namespace
}  // namespace triptych
