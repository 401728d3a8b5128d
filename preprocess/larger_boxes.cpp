#include "preprocess/larger_boxes.hpp"

#include <algorithm>
#include <numeric>

namespace triptych {

namespace {

std::vector<uint32_t> ranks_of(const std::vector<Box>& boxes) {
  std::vector<uint32_t> by_size(boxes.size());
  std::iota(by_size.begin(), by_size.end(), 0u);
  std::stable_sort(by_size.begin(), by_size.end(),
                   [&](uint32_t a, uint32_t b) { return diagonal(boxes[a]) > diagonal(boxes[b]); });
  std::vector<uint32_t> ranks(boxes.size());
  for (uint32_t rank = 0; rank < by_size.size(); ++rank) ranks[by_size[rank]] = rank;
  return ranks;
}

}  // namespace

LargerBoxes::LargerBoxes(const std::vector<Box>& boxes)
    : boxes_(boxes), ranks_(ranks_of(boxes)), tree_(boxes, ranks_) {}

}  // namespace triptych
