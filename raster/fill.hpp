// Fills triangles, row by row, into a band of rows.
#pragma once

#include "raster/slots.hpp"
#include "raster/triangle.hpp"

#include <bit>
#include <cstdint>
#include <span>

namespace triptych {

/// A buffer of width pixels a row, from bottom to top.
template <typename Word>
struct PixelBuffer {
  Word* words;
  int width;
  Word* row(int32_t y) const { return words + static_cast<size_t>(y) * static_cast<size_t>(width); }
};

/// Depth alone: the bits of a positive float; 0 where nothing was drawn.
struct DepthWriter {
  using Word = uint32_t;
  void write(Word& word, float depth, uint32_t) const {
    const auto bits = std::bit_cast<uint32_t>(depth);
    if (depth > 0 && bits > word) word = bits;
  }
};

/// The visibility buffer.
struct VisibilityWriter {
  using Word = VisibilityWord;
  const SlotTable& slots;
  void write(Word& word, float depth, uint32_t slot) const {
    if (!(depth > 0)) return;
    const Word key = Word{std::bit_cast<uint32_t>(depth)} << 32;
    const Word there = word & ~Word{0xffffffffu};
    if (key > there || (key == there && slots.precedes(slot, slot_of(word)))) word = key | slot;
  }
};

/// Of a row those pixels, counted from the triangle's left, that all edges hold; empty where first > last.
struct RowSpan {
  int64_t first, last;
};
RowSpan row_span(const WindowTriangle& triangle, int32_t row);

/// Rows first_row to last_row, both included.
template <typename Writer>
void fill(const WindowTriangle& triangle, int32_t first_row, int32_t last_row,
          PixelBuffer<typename Writer::Word> buffer, const Writer& writer) {
  const int32_t bottom = triangle.bottom > first_row ? triangle.bottom : first_row;
  const int32_t top = triangle.top < last_row ? triangle.top : last_row;
  for (int32_t y = bottom; y <= top; ++y) {
    const RowSpan span = row_span(triangle, y - triangle.bottom);
    typename Writer::Word* words = buffer.row(y);
    for (int64_t i = span.first; i <= span.last; ++i) {
      const int32_t x = triangle.left + static_cast<int32_t>(i);
      float depth = triangle.depth_at(x, y);
      if (triangle.bound != nullptr) {
        const float bound = bound_at(*triangle.bound, x, y);
        depth = bound < depth ? bound : depth;
      }
      writer.write(words[x], depth, triangle.slot);
    }
  }
}

}  // namespace triptych
