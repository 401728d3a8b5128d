// Filling triangles by the way that suits their size. Included once by the file
// of each instruction set.
#pragma once

#include "raster/simd/fill_wide.hpp"

namespace triptych {
namespace {

/// Whether no edge function exceeds 32 bits at the pixels of its rows and
/// `lanes` columns on either side.
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
[[gnu::always_inline]] inline void fill_rows(const FillTriangle& triangle, int32_t bottom, int32_t top,
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
    const Mask covered = where_greater(all_lanes, edge[0] | edge[1] | edge[2], splat(-1));
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
    if (!is_hidden(triangle, bottom, top, target)) fill_rows<plain>(triangle, bottom, top, pixels);
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

[[gnu::always_inline]] inline FillTriangle lane_of(const NarrowTriangles& all, int32_t i) {
  return {.edge = {all.edge[0][i], all.edge[1][i], all.edge[2][i]},
          .step_x = {all.step_x[0][i], all.step_x[1][i], all.step_x[2][i]},
          .step_y = {all.step_y[0][i], all.step_y[1][i], all.step_y[2][i]},
          .left = all.left[i],
          .right = all.right[i],
          .bottom = all.bottom[i],
          .top = all.top[i],
          .first_x = all.first_x[i],
          .first_y = all.first_y[i],
          .z = all.z[i],
          .slope_x = all.slope_x[i],
          .slope_y = all.slope_y[i],
          .low = all.low[i],
          .high = all.high[i],
          .slot = all.slot[i],
          .precise = false,
          .precise_x = 0,
          .precise_y = 0,
          .limit = nullptr,
          .sides = nullptr,
          .cut = 0};
}

void fill_narrow(const NarrowTriangles& triangles, int32_t first_row, int32_t last_row,
                 const FillTarget& target) {
  for (uint32_t rest = triangles.held; rest != 0; rest &= rest - 1) {
    const FillTriangle triangle = lane_of(triangles, __builtin_ctz(rest));
    const int32_t bottom = greater(triangle.bottom, first_row), top = lesser(triangle.top, last_row);
    if (bottom > top || is_hidden(triangle, bottom, top, target)) continue;
    Pixels pixels(target, triangle.slot);
    fill_rows<true>(triangle, bottom, top, pixels);
  }
}

void fill_fragments(const Fragments& fragments, int32_t count, int32_t first_row, int32_t last_row,
                    const FillTarget& target) {
  for (int32_t i = 0; i < count; ++i) {
    const auto y = static_cast<int32_t>(fragments.places[i] >> 16),
               x = static_cast<int32_t>(fragments.places[i] & 0xffff);
    if (y < first_row || y > last_row) continue;
    const int64_t pixel = int64_t{y} * target.stride + x;
    const uint32_t depth = fragments.depths[i], slot = fragments.slots[i];
    if (depth < target.depths[pixel]) continue;
    if (depth == target.depths[pixel] &&
        (target.slots == nullptr || !target.precedes(target.order, slot, target.slots[pixel])))
      continue;
    target.depths[pixel] = depth;
    if (target.slots != nullptr) target.slots[pixel] = slot;
    target.marked[int64_t{y / tile} * target.columns + x / tile] = 1;
  }
}

}  // namespace
}  // namespace triptych
