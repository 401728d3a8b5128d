// Colours of a row, a vector of pixels at a time. Included once by the file of
// each instruction set.
#pragma once

#include "raster/simd/kernels.hpp"
#include "raster/simd/vector.hpp"

namespace triptych {
namespace {

/// empty: pixels of no triangle, whose slots have no meaning.
[[gnu::always_inline]] inline Ints colors_of(const SlotColors& colors, Ints slots, Ints empty) {
  const Ints place = slots & static_cast<int32_t>(colors.kept_mask);
  Ints result = gather(reinterpret_cast<const int32_t*>(colors.kept_colors), place);
  const Ints kept = gather(reinterpret_cast<const int32_t*>(colors.kept_slots), place);
  result = select(empty, splat(static_cast<int32_t>(colors.background)), result);
  for (Ints missing = ~empty & (kept != slots); any(missing);) {
    const int32_t slot = slots[__builtin_ctz(bits(missing))];
    const uint32_t color = colors.of_slot(colors.context, static_cast<uint32_t>(slot));
    const Ints same = missing & (slots == slot);
    result = select(same, splat(static_cast<int32_t>(color)), result);
    missing &= ~same;
  }
  return result;
}

void color_row(const SlotColors& colors, const uint32_t* depths, const uint32_t* slots, int32_t count,
               void* row) {
  auto* const to = static_cast<uint32_t*>(row);
  for (int32_t x = 0; x < count; x += lanes) {
    const int32_t left = lesser(count - x, lanes);
    const Ints empty = (load(depths + x) == 0) | (lane_numbers >= left), own = load(slots + x);
    const Ints result = colors_of(colors, own, empty);
    if (left == lanes) {
      store(result, to + x);
    } else {
      __builtin_memcpy(to + x, &result, static_cast<size_t>(left) * sizeof(uint32_t));
    }
  }
}

}  // namespace
}  // namespace triptych
