// Colours of a row, run by run of pixels that show the same triangle. Included once by the file of each
// instruction set.
#pragma once

#include "raster/simd/kernels.hpp"
#include "raster/simd/vector.hpp"

namespace triptych {
namespace {

void color_row(const SlotColors& colors, const uint32_t* depths, const uint32_t* slots, int32_t count,
               void* row) {
  auto* const to = static_cast<uint32_t*>(row);
  for (int32_t x = 0; x < count;) {
    // Where nothing is, slots have no meaning.
    const bool empty = depths[x] == 0;
    const uint32_t color = empty ? colors.background : colors.of_slot(colors.context, slots[x]);
    const Ints own = splat(static_cast<int32_t>(slots[x]));
    for (bool same = true; same && x < count;) {
      const Ints nothing = load(depths + x) == 0;
      const uint32_t others = bits(empty ? ~nothing : nothing | (load(slots + x) != own));
      const int32_t run = others == 0 ? lanes : __builtin_ctz(others);
      same = others == 0;
      if (x + lanes <= count) {
        store(splat(static_cast<int32_t>(color)), to + x);  // what is behind the run is written again
      } else {
        for (int32_t i = x; i < count && i < x + run; ++i) __builtin_memcpy(to + i, &color, sizeof color);
      }
      x += run;
    }
  }
}

}  // namespace
}  // namespace triptych
