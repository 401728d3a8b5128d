#include "preprocess/contacts/overlapping_boxes.hpp"

#include "base/threads.hpp"
#include "preprocess/contacts/box_tree.hpp"

#include <algorithm>
#include <atomic>
#include <numeric>

namespace triptych {

OverlappingBoxes overlapping_boxes(const std::vector<Box>& boxes, size_t most) {
  std::vector<uint32_t> by_size(boxes.size());
  std::iota(by_size.begin(), by_size.end(), 0u);
  std::stable_sort(by_size.begin(), by_size.end(),
                   [&](uint32_t a, uint32_t b) { return diagonal(boxes[a]) > diagonal(boxes[b]); });
  std::vector<uint32_t> ranks(boxes.size());
  for (uint32_t rank = 0; rank < by_size.size(); ++rank) ranks[by_size[rank]] = rank;
  const BoxTree tree(boxes, ranks);
  OverlappingBoxes overlapping;
  overlapping.larger.resize(boxes.size());
  std::atomic<uint64_t> crowded = 0;
  parallel_for(boxes.size(), [&](size_t i) {
    tree.visit_below(boxes[i], ranks[i], [&](uint32_t other) {
      if (overlapping.larger[i].size() == most) {
        ++crowded;
        return false;
      }
      overlapping.larger[i].push_back(other);
      return true;
    });
  });
  overlapping.crowded = crowded;
  return overlapping;
}

}  // namespace triptych
