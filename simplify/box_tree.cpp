#include "simplify/box_tree.hpp"

#include "simplify/median_split.hpp"

#include <algorithm>
#include <numeric>

namespace triptych {

namespace {

constexpr uint32_t leaf_boxes = 4;

}  // namespace

BoxTree::BoxTree(std::vector<Box> boxes, std::vector<uint32_t> ranks)
    : boxes_(std::move(boxes)), ranks_(std::move(ranks)), order_(boxes_.size()) {
  if (boxes_.empty()) return;
  std::iota(order_.begin(), order_.end(), 0u);
  std::vector<glm::dvec3> centers;
  for (const Box& box : boxes_) centers.push_back(center(box));
  nodes_.reserve(boxes_.size());
  build(0, static_cast<uint32_t>(boxes_.size()), centers);
  // A subtree is contiguous: whatever comes after it is the next node that is not in it.
  for (Node& node : nodes_) {
    if (node.behind == nodes_.size()) node.behind = end;
  }
}

void BoxTree::build(uint32_t first, uint32_t last, std::vector<glm::dvec3>& centers) {
  const auto index = static_cast<uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Box box;
  for (uint32_t i = first; i < last; ++i) box.extend(boxes_[order_[i]]);
  nodes_[index].box = box;
  if (!ranks_.empty()) {
    nodes_[index].least_rank = end;
    for (uint32_t i = first; i < last; ++i)
      nodes_[index].least_rank = std::min(nodes_[index].least_rank, ranks_[order_[i]]);
  }
  if (last - first <= leaf_boxes) {
    nodes_[index].first = first;
    nodes_[index].count = last - first;
  } else {
    const auto range = std::span(order_).subspan(first, last - first);
    split_at_median(range, centers);
    const uint32_t middle = first + static_cast<uint32_t>(range.size() / 2);
    build(first, middle, centers);
    build(middle, last, centers);
  }
  nodes_[index].behind = static_cast<uint32_t>(nodes_.size());
}

}  // namespace triptych
