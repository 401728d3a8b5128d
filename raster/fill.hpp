// Fills triangles pixel by pixel: what the kernels of all instruction sets are held to.
#pragma once

#include "raster/cut_out.hpp"

#include <bit>
#include <cstdint>

namespace triptych {

/// Of a row those pixels, counted from the triangle's left, that all edges hold; empty where first > last.
struct RowSpan {
  int64_t first, last;
};
RowSpan row_span(const FillTriangle& triangle, int32_t row);

/// Rows first_row to last_row, both included. write(x, y, depth): called once for each pixel that a section
/// keeps.
template <typename Write>
void for_each_pixel(const FillTriangle& triangle, int32_t first_row, int32_t last_row, const Write& write) {
  const int32_t bottom = triangle.bottom > first_row ? triangle.bottom : first_row;
  const int32_t top = triangle.top < last_row ? triangle.top : last_row;
  for (int32_t y = bottom; y <= top; ++y) {
    const RowSpan span = row_span(triangle, y - triangle.bottom);
    for (int64_t i = span.first; i <= span.last; ++i) {
      const int32_t x = triangle.left + static_cast<int32_t>(i);
      float depth = depth_at(triangle, x, y);
      if (triangle.limit != nullptr) {
        const float limit = limit_at(*triangle.limit, x, y);
        depth = limit < depth ? limit : depth;
      }
      if (triangle.sides != nullptr && !keeps(*triangle.sides, triangle.cut, x, y, depth)) continue;
      write(x, y, depth);
    }
  }
}

/// Leaves `tiles` as they are, and marks nothing.
void fill(const FillTriangle& triangle, int32_t first_row, int32_t last_row, const FillTarget& target);

/// The same, where the triangle has no holes.
void fill_cut_out(const CutOutTriangle& triangle, int32_t first_row, int32_t last_row,
                  const FillTarget& target);

}  // namespace triptych
