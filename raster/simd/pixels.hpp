// Writing depths, and the slots of triangles, into some pixels of a row. Included once by the file of each
// instruction set.
#pragma once

#include "raster/fill_triangle.hpp"
#include "raster/simd/vector.hpp"

namespace triptych {
namespace {

/// What one triangle is written into.
class Pixels {
 public:
  [[gnu::always_inline]] Pixels(const FillTarget& target, uint32_t slot)
      : target_(target), depths_(target.depths), slots_(target.slots), slot_(slot) {}

  const FillTarget& target() const { return target_; }

  /// depth: bits. Positive ones are ordered as floats are; the others are not above zero.
  [[gnu::always_inline]] void write(int64_t pixel, Ints mask, Ints depth) {
    const Ints there = load(depths_ + pixel);
    // Branches cost more than storing what was there: which pixels are nearer is hard to foresee.
    const Ints nearer = (depth > there) & mask;
    store(select(nearer, depth, there), depths_ + pixel);
    if (slots_ == nullptr) return;
    store(select(nearer, splat(static_cast<int32_t>(slot_)), load(slots_ + pixel)), slots_ + pixel);
    for (uint32_t equal = bits((depth == there) & (depth > 0) & mask); equal != 0; equal &= equal - 1) {
      uint32_t& other = slots_[pixel + __builtin_ctz(equal)];
      if (precedes(other)) other = slot_;
    }
  }

 private:
  [[gnu::always_inline]] bool precedes(uint32_t other) {
    if (!known_ || other != known_other_) {
      known_ = true;
      known_other_ = other;
      wins_ = target_.precedes(target_.order, slot_, other);
    }
    return wins_;
  }

  const FillTarget& target_;
  uint32_t* depths_;
  uint32_t* slots_;
  uint32_t slot_;
  // The last answer of `precedes`: where triangles coincide, they do in many pixels.
  uint32_t known_other_ = 0;
  bool known_ = false, wins_ = false;
};

}  // namespace
}  // namespace triptych
