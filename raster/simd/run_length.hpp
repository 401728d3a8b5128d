// Runs of pixels that show the same triangle. Included once by the file of each instruction set.
#pragma once

#include "raster/simd/vector.hpp"

namespace triptych {
namespace {

int32_t run_length(const uint32_t* depths, const uint32_t* slots, int32_t count) {
  const bool empty = depths[0] == 0;
  const uint32_t slot = slots[0];
  int32_t x = 0;
  for (; x + lanes <= count; x += lanes) {
    const Ints nothing = load(depths + x) == 0;
    const Ints other = empty ? ~nothing : nothing | (load(slots + x) != static_cast<int32_t>(slot));
    const uint32_t differ = bits(other);
    if (differ != 0) return x + __builtin_ctz(differ);
  }
  while (x < count && (empty ? depths[x] == 0 : depths[x] != 0 && slots[x] == slot)) ++x;
  return x;
}

}  // namespace
}  // namespace triptych
