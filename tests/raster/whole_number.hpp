// Random whole numbers for the rasteriser's tests.
#pragma once

#include "tests/support/scenes.hpp"

namespace triptych {

/// From lo to hi, both included.
inline int whole_number(scenes::Random& random, int lo, int hi) {
  return lo + static_cast<int>(random.index(static_cast<size_t>(hi - lo) + 1));
}

}  // namespace triptych
