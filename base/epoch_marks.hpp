// Marks on numbered things, all of which can be cleared at once in constant time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace triptych {

/// One mark for each of `count` things, of two bytes. clear() hardly ever touches them, so that the cost of a
/// frame depends on what it marks, not on how many there are.
class EpochMarks {
 public:
  explicit EpochMarks(size_t count) : stamps_(count, 0) {}

  void clear() {
    if (++epoch_ != 0) return;
    std::fill(stamps_.begin(), stamps_.end(), 0);  // once in 2¹⁶ calls
    epoch_ = 1;
  }
  void mark(size_t i) { stamps_[i] = epoch_; }
  bool marked(size_t i) const { return stamps_[i] == epoch_; }
  /// Marks it; returns whether it was not marked before.
  bool mark_first(size_t i) {
    if (marked(i)) return false;
    mark(i);
    return true;
  }

 private:
  std::vector<uint16_t> stamps_;
  uint16_t epoch_ = 1;
};

}  // namespace triptych
