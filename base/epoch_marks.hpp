// Marks on numbered things that are all taken away at once, in no time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace triptych {

/// One mark for each of `count` things. clear() does not touch them, so that a frame pays for what it marks
/// and not for what there is.
class EpochMarks {
 public:
  explicit EpochMarks(size_t count) : stamps_(count, 0) {}

  void clear() {
    if (++epoch_ != 0) return;
    std::fill(stamps_.begin(), stamps_.end(), 0);  // once in four thousand million times
    epoch_ = 1;
  }
  void mark(size_t i) { stamps_[i] = epoch_; }
  bool marked(size_t i) const { return stamps_[i] == epoch_; }
  /// Marks it; whether it was not marked before.
  bool mark_first(size_t i) {
    if (marked(i)) return false;
    mark(i);
    return true;
  }

 private:
  std::vector<uint32_t> stamps_;
  uint32_t epoch_ = 1;
};

}  // namespace triptych
