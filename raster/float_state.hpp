// Floating point as the rasteriser needs it, whatever the program around us has set.
#pragma once

#include "base/rounding.hpp"

#include <xmmintrin.h>

namespace triptych {

/// While it lives, arithmetic of this thread rounds to nearest, keeps denormals, and raises no traps. What is
/// to be computed under it belongs into a function that is not inlined where it is made: compilers move
/// arithmetic over it otherwise.
class FloatState {
 public:
  FloatState() : before_(_mm_getcsr()) { _mm_setcsr(defaults); }
  ~FloatState() { _mm_setcsr(before_); }
  FloatState(const FloatState&) = delete;
  FloatState& operator=(const FloatState&) = delete;

 private:
  static constexpr unsigned defaults = 0x1f80;
  NearestRounding rounding_;  // the old unit's mode, too, which the C library goes by
  unsigned before_;
};

}  // namespace triptych
