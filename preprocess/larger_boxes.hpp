// Which larger boxes a box overlaps: each pair of overlapping boxes is seen from the smaller one, so that no
// box sees very many because it is large.
#pragma once

#include "simplify/box_tree.hpp"

#include <cstdint>
#include <vector>

namespace triptych {

class LargerBoxes {
 public:
  explicit LargerBoxes(const std::vector<Box>& boxes);

  /// Calls visit(other) for each box that shares a point with this one and has a longer diagonal, or one that
  /// is as long and a smaller index, until that returns false.
  template <typename Visit>
  void visit(uint32_t index, const Visit& visit) const {
    tree_.visit_below(boxes_[index], ranks_[index], visit);
  }

 private:
  const std::vector<Box>& boxes_;
  std::vector<uint32_t> ranks_;  ///< 0 for the largest
  BoxTree tree_;
};

}  // namespace triptych
