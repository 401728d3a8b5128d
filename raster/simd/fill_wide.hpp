// Triangles wider than a vector: by tiles, then by rows. Included once by the
// file of each instruction set.
#pragma once

#include "raster/simd/pixels.hpp"
#include "raster/simd/row_depth.hpp"
#include "raster/simd/tiles.hpp"
#include "raster/simd/vector.hpp"

namespace triptych {
namespace {

/// Of the rows of a row of tiles those columns that all edges hold; empty where
/// first > last.
struct TileRowSpans {
  int32_t first[tile], last[tile];
};

/// Which columns of a row all edges hold. Edge functions are whole numbers far
/// below 2⁵², and steps below 2²⁴: a half more than one, over a step, is no
/// nearer to a whole number than 2⁻²⁵, and products with what one over the step
/// is rounded to are off by less wherever a picture may be. So both have the
/// same whole part.
class SpansOf {
 public:
  [[gnu::always_inline]] explicit SpansOf(const FillTriangle& triangle) : triangle_(triangle) {
    for (int k = 0; k < 3; ++k) {
      step_[k] = triangle.step_x[k];
      per_step_[k] = 1 / (step_[k] < 0 ? -step_[k] : step_[k]);  // not used where that is 0
    }
  }

  [[gnu::always_inline]] TileRowSpans of_rows(int32_t first_row) const {
    constexpr int32_t rows = lanes / 2;  // of a vector
    constexpr double beyond = 1 << 20;   // of any picture
    TileRowSpans spans;
    for (int32_t from = 0; from < tile; from += rows) {
      const Doubles row = to_double(half_lane_numbers + (first_row + from - triangle_.bottom));
      Doubles first = splat_double(0), last = splat_double(triangle_.right - triangle_.left);
      for (int k = 0; k < 3; ++k) {
        const Doubles at =
            static_cast<double>(triangle_.edge[k]) + static_cast<double>(triangle_.step_y[k]) * row;
        if (step_[k] > 0) {
          const Doubles bound = (step_[k] - 0.5 - at) * per_step_[k];
          first = bound > first ? bound : first;
        } else if (step_[k] < 0) {
          // What lies between −1 and 0 would become 0.
          const Doubles bound = at < 0 ? splat_double(-1) : (at + 0.5) * per_step_[k];
          last = bound < last ? bound : last;
        } else {
          last = at < 0 ? splat_double(-1) : last;
        }
      }
      first = first < beyond ? first : splat_double(beyond);
      const HalfInts columns = to_int(first) + triangle_.left, ends = to_int(last) + triangle_.left;
      __builtin_memcpy(spans.first + from, &columns, sizeof columns);
      __builtin_memcpy(spans.last + from, &ends, sizeof ends);
    }
    return spans;
  }

 private:
  const FillTriangle& triangle_;
  double step_[3], per_step_[3];
};

template <bool plain>
[[gnu::always_inline]] inline void fill_span(const RowDepth<plain>& depth, int32_t y, int32_t first,
                                             int32_t last, Pixels& pixels) {
  const int64_t row = int64_t{y} * pixels.target().stride;
  for (int32_t x = first & -lanes; x <= last; x += lanes) {  // whole cache lines
    const Ints column = lane_numbers + x;
    pixels.write(row + x,
                 where_greater(where_greater(all_lanes, column, splat(first - 1)), splat(last + 1), column),
                 depth.at(column));
  }
}

template <bool plain>
[[gnu::always_inline]] inline void fill_tile_row(const FillTriangle& triangle, const TileRow& row,
                                                 const TileRowSpans& spans, RowDepth<plain>& depth,
                                                 Pixels& pixels) {
  int32_t first = pixels.target().width, last = -1;
  for (int32_t y = row.bottom; y <= row.top; ++y) {
    const int32_t i = y - row.index * tile;
    if (spans.first[i] > spans.last[i]) continue;
    first = lesser(first, spans.first[i]);
    last = greater(last, spans.last[i]);
  }
  for (int32_t from = first / tile; from * tile <= last; from += lanes) {
    uint32_t open = row.open(triangle, from, last / tile - from + 1);
    while (open != 0) {
      // A run of tiles that do not hide it.
      const int32_t start = __builtin_ctz(open);
      const uint32_t beyond = ~(open >> start);
      const int32_t count = __builtin_ctz(beyond);  // the highest bit is never set
      open &= ~(((1u << count) - 1) << start);
      const int32_t run_first = from + start, run_last = run_first + count - 1;
      for (int32_t y = row.bottom; y <= row.top; ++y) {
        const int32_t i = y - row.index * tile;
        depth.go_to(y);
        fill_span(depth, y, greater(spans.first[i], run_first * tile),
                  lesser(spans.last[i], run_last * tile + tile - 1), pixels);
      }
      row.mark(run_first, run_last);
    }
  }
}

template <bool plain>
[[gnu::always_inline]] inline void fill_wide(const FillTriangle& triangle, int32_t bottom, int32_t top,
                                             Pixels& pixels) {
  RowDepth<plain> depth(triangle);
  const SpansOf spans(triangle);
  for (int32_t index = bottom / tile; index <= top / tile; ++index) {
    fill_tile_row<plain>(
        triangle,
        {pixels.target(), index, greater(bottom, index * tile), lesser(top, index * tile + tile - 1)},
        spans.of_rows(index * tile), depth, pixels);
  }
}

}  // namespace
}  // namespace triptych
