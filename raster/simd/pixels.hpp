// Writing depths, and the slots of triangles, into some pixels of a row.
// Included once by the file of each instruction set.
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

  /// depth: bits. Positive ones are ordered as floats are; the others are not
  /// above zero.
  [[gnu::always_inline]] void write(int64_t pixel, Mask mask, Ints depth) {
    const Ints there = load(depths_ + pixel);
    // Branches cost more than storing what was there: which pixels are nearer
    // is hard to foresee.
    const Mask nearer = where_greater(mask, depth, there);
    store(choose(nearer, depth, there), depths_ + pixel);
    if (slots_ == nullptr) return;
    store(choose(nearer, splat(static_cast<int32_t>(slot_)), load(slots_ + pixel)), slots_ + pixel);
    const uint32_t equal = mask_bits(where_equal(mask, depth, there));
    if (equal != 0) [[unlikely]]
      settle(pixel, equal & mask_bits(where_greater(mask, depth, Ints{})));
  }

 private:
  /// Pixels of equal depth, a bit each.
  [[gnu::always_inline]] void settle(int64_t pixel, uint32_t equal) {
    for (; equal != 0; equal &= equal - 1) {
      uint32_t& other = slots_[pixel + __builtin_ctz(equal)];
      if (precedes(other)) other = slot_;
    }
  }
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
  // The last answer of `precedes`: where triangles coincide, they do in many
  // pixels.
  uint32_t known_other_ = 0;
  bool known_ = false, wins_ = false;
};

}  // namespace
}  // namespace triptych
