// Filling triangles, some pixels of a row at a time. Included once by the file of each instruction set.
#pragma once

#include "raster/simd/kernels.hpp"
#include "raster/simd/vector.hpp"

namespace triptych {
namespace {

/// Writes depths into a row of words that are nothing else.
struct DepthPixels {
  using Word = uint32_t;
  [[gnu::always_inline]] void end_row(int32_t) {}
  [[gnu::always_inline]] void write(Word* words, Ints mask, Ints depth) {
    const Ints there = load(words);
    const Ints nearer = (depth > there) & mask;
    if (any(nearer)) store(select(nearer, depth, there), words);
  }
};

/// Writes words of a depth above a slot. Where depths are equal nothing is written, but noted.
struct VisibilityPixels {
  using Word = uint64_t;
  Ints slot;
  Ints equal = {};  ///< in this row
  Rows equal_rows = {1, 0};
  [[gnu::always_inline]] void end_row(int32_t y) {
    if (!any(equal)) return;
    equal = Ints{};
    if (equal_rows.first > equal_rows.last) equal_rows.first = y;
    equal_rows.last = y;
  }
  [[gnu::always_inline]] void write(Word* words, Ints mask, Ints depth) {
    const Ints low = load(words), high = load(words + lanes / 2);
    const Ints there = odd(low, high);
    const Ints nearer = (depth > there) & mask;
    equal |= (depth == there) & (depth > 0) & mask;
    if (!any(nearer)) return;
    store(select(low_pairs(nearer, nearer), low_pairs(slot, depth), low), words);
    store(select(high_pairs(nearer, nearer), high_pairs(slot, depth), high), words + lanes / 2);
  }
};

/// A row of a triangle.
struct RowDepth {
  Floats start, slope, low, high;
  /// The bits of the depth so many sub-pixels beside the first corner. Positive ones are ordered as floats
  /// are; the others are not above zero.
  [[gnu::always_inline]] Ints at(Ints dx) const {
    const Floats depth = start + slope * to_float(dx);
    return bits_of(select(depth < low, low, select(depth > high, high, depth)));
  }
};

[[gnu::always_inline]] inline int32_t centre(int32_t pixel) { return pixel * 256 + 128; }

[[gnu::always_inline]] inline RowDepth row_depth(const FillTriangle& triangle, int32_t y) {
  const auto dy = static_cast<float>(centre(y) - triangle.first_y);
  return {splat(triangle.z + triangle.slope_y * dy), splat(triangle.slope_x), splat(triangle.low),
          splat(triangle.high)};
}

/// Whether no edge function exceeds 32 bits at the pixels of so many rows and `lanes` columns on either side.
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

/// No wider than a vector: every pixel of a row at once.
template <typename Pixels>
[[gnu::always_inline]] inline void fill_narrow(const FillTriangle& triangle, int32_t bottom, int32_t top,
                                               typename Pixels::Word* words, int32_t width, Pixels& pixels) {
  // Not beyond the row's end, which may be another thread's.
  const int32_t x = triangle.left < width - lanes ? triangle.left : width - lanes;
  const Ints column = lane_numbers + (x - triangle.left);
  const Ints dx = (lane_numbers + x) * 256 + (128 - triangle.first_x);
  Ints edge[3];
  for (int k = 0; k < 3; ++k) {
    edge[k] = column * triangle.step_x[k] +
              (static_cast<int32_t>(triangle.edge[k]) + triangle.step_y[k] * (bottom - triangle.bottom));
  }
  for (int32_t y = bottom; y <= top; ++y) {
    const Ints covered = (edge[0] | edge[1] | edge[2]) >= 0;
    if (any(covered)) {
      const auto offset = static_cast<int64_t>(y) * width + x;
      pixels.write(words + offset, covered, row_depth(triangle, y).at(dx));
      pixels.end_row(y);
    }
    for (int k = 0; k < 3; ++k) edge[k] += triangle.step_y[k];
  }
}

/// Of a row those pixels, counted from the triangle's left, that all edges hold.
struct Span {
  int64_t first, last;
};
[[gnu::always_inline]] inline Span span_of_row(const FillTriangle& triangle, int32_t row) {
  Span span{0, triangle.right - triangle.left};
  for (int k = 0; k < 3; ++k) {
    const int64_t at = triangle.edge[k] + int64_t{triangle.step_y[k]} * row, step = triangle.step_x[k];
    // Quotients of integers below 2^52 are rounded to no other integer: the whole part is exact.
    if (step > 0) {
      if (at >= 0) continue;
      const auto first = static_cast<int64_t>(static_cast<double>(step - 1 - at) / static_cast<double>(step));
      if (first > span.first) span.first = first;
    } else if (at < 0) {
      return {1, 0};
    } else if (step < 0) {
      const auto last = static_cast<int64_t>(static_cast<double>(at) / static_cast<double>(-step));
      if (last < span.last) span.last = last;
    }
  }
  return span;
}

template <typename Pixels>
[[gnu::always_inline]] inline void fill_wide(const FillTriangle& triangle, int32_t bottom, int32_t top,
                                             typename Pixels::Word* words, int32_t width, Pixels& pixels) {
  for (int32_t y = bottom; y <= top; ++y) {
    const Span span = span_of_row(triangle, y - triangle.bottom);
    if (span.first > span.last) continue;
    const RowDepth depth = row_depth(triangle, y);
    const int32_t first = triangle.left + static_cast<int32_t>(span.first),
                  last = triangle.left + static_cast<int32_t>(span.last);
    typename Pixels::Word* const row = words + static_cast<int64_t>(y) * width;
    for (int32_t x = first; x <= last; x += lanes) {
      const int32_t start = x < width - lanes ? x : width - lanes;
      const Ints column = lane_numbers + start;
      pixels.write(row + start, (column >= x) & (column <= last),
                   depth.at(column * 256 + (128 - triangle.first_x)));
    }
    pixels.end_row(y);
  }
}

template <typename Pixels>
[[gnu::always_inline]] inline void fill_rows(const FillTriangle& triangle, int32_t first_row,
                                             int32_t last_row, typename Pixels::Word* words, int32_t width,
                                             Pixels& pixels) {
  const int32_t bottom = triangle.bottom > first_row ? triangle.bottom : first_row,
                top = triangle.top < last_row ? triangle.top : last_row;
  if (triangle.right - triangle.left < lanes && is_small(triangle)) {
    fill_narrow(triangle, bottom, top, words, width, pixels);
  } else {
    fill_wide(triangle, bottom, top, words, width, pixels);
  }
}

void fill_depths(const FillTriangle& triangle, int32_t first_row, int32_t last_row, uint32_t* words,
                 int32_t width) {
  DepthPixels pixels;
  fill_rows(triangle, first_row, last_row, words, width, pixels);
}

Rows fill_words(const FillTriangle& triangle, int32_t first_row, int32_t last_row, uint64_t* words,
                int32_t width) {
  VisibilityPixels pixels{.slot = splat(static_cast<int32_t>(triangle.slot))};
  fill_rows(triangle, first_row, last_row, words, width, pixels);
  return pixels.equal_rows;
}

}  // namespace
}  // namespace triptych
