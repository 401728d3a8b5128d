#include "raster/fill.hpp"

#include <algorithm>

namespace triptych {

namespace {
/// Both positive, or zero above.
int64_t divide_up(int64_t a, int64_t b) { return (a + b - 1) / b; }

/// Where few pixels are in question, trying them costs less than divisions.
constexpr int64_t few = 4;

bool covered(const FillTriangle& triangle, int32_t row, int64_t i) {
  for (size_t k = 0; k < 3; ++k) {
    if (triangle.edge[k] + int64_t{triangle.step_y[k]} * row + triangle.step_x[k] * i < 0) return false;
  }
  return true;
}
}  // namespace

RowSpan row_span(const FillTriangle& triangle, int32_t row) {
  RowSpan span{0, triangle.right - triangle.left};
  if (span.last < few) {
    while (span.first <= span.last && !covered(triangle, row, span.first)) ++span.first;
    while (span.first <= span.last && !covered(triangle, row, span.last)) --span.last;
    return span;
  }
  for (size_t k = 0; k < 3; ++k) {
    const int64_t at = triangle.edge[k] + int64_t{triangle.step_y[k]} * row, step = triangle.step_x[k];
    if (step > 0) {
      if (at < 0) span.first = std::max(span.first, divide_up(-at, step));
    } else if (at < 0) {
      return {1, 0};
    } else if (step < 0) {
      span.last = std::min(span.last, at / -step);
    }
  }
  return span;
}

namespace {

/// Of the triangle with this slot.
void write_fragment(const FillTarget& target, uint32_t own_slot, int32_t x, int32_t y, float depth) {
  if (!(depth > 0)) return;
  const size_t pixel = static_cast<size_t>(y) * static_cast<size_t>(target.stride) + static_cast<size_t>(x);
  uint32_t& there = target.depths[pixel];
  const auto bits = std::bit_cast<uint32_t>(depth);
  if (bits < there) return;
  if (target.slots != nullptr) {
    uint32_t& slot = target.slots[pixel];
    if (bits == there && !target.precedes(target.order, own_slot, slot)) return;
    slot = own_slot;
  }
  there = bits;
}

}  // namespace

void fill(const FillTriangle& triangle, int32_t first_row, int32_t last_row, const FillTarget& target) {
  for_each_pixel(triangle, first_row, last_row, [&](int32_t x, int32_t y, float depth) {
    write_fragment(target, triangle.slot, x, y, depth);
  });
}

void fill_cut_out(const CutOutTriangle& triangle, int32_t first_row, int32_t last_row,
                  const FillTarget& target) {
  for_each_pixel(triangle.window, first_row, last_row, [&](int32_t x, int32_t y, float depth) {
    const size_t pixel = static_cast<size_t>(y) * static_cast<size_t>(target.stride) + static_cast<size_t>(x);
    const bool is_hidden = std::bit_cast<uint32_t>(depth) < target.depths[pixel];
    if (!is_hidden && triangle.is_solid(x, y)) write_fragment(target, triangle.window.slot, x, y, depth);
  });
}

}  // namespace triptych
