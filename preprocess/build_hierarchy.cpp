#include "preprocess/build_hierarchy.hpp"

#include "preprocess/joint_ranges.hpp"
#include "simplify/median_split.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace triptych {

namespace {

using Range = std::span<uint32_t>;

class Splitter {
 public:
  Splitter(std::span<const ObjectExtent> objects, std::span<const uint64_t> leaves)
      : objects_(objects), leaves_(leaves) {
    for (const auto& [box, triangles] : objects) centers_.push_back(center(box));
  }

  /// At the median along the longest axis of the centres.
  std::vector<Range> halves(Range range) const {
    split_at_median(range, centers_);
    return {range.first(range.size() / 2), range.subspan(range.size() / 2)};
  }

  /// At the median of the leaves along the axis with the least expected cost; where the median is within an
  /// object, on the side with the least cost.
  std::vector<Range> small_halves(Range range) const {
    std::pair<int, size_t> best{0, range.size() / 2};  // axis, and size of the first half
    double least = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      sort(range, axis);
      const auto [fewest, most] = middles(range);
      for (size_t first = fewest; first <= most; ++first) {
        const double cost = cost_of(range.first(first)) + cost_of(range.subspan(first));
        if (cost < least) {
          least = cost;
          best = {axis, first};
        }
      }
    }
    sort(range, best.first);
    return {range.first(best.second), range.subspan(best.second)};
  }

 private:
  uint64_t leaves_of(uint32_t object) const { return leaves_.empty() ? 1 : leaves_[object]; }
  uint64_t leaves_of(Range range) const {
    uint64_t leaves = 0;
    for (const uint32_t object : range) leaves += leaves_of(object);
    return leaves;
  }

  /// How many objects of the range, of two or more, come before its middle: without the one that the middle
  /// is within, and with it.
  std::pair<size_t, size_t> middles(Range range) const {
    const uint64_t all = leaves_of(range);
    uint64_t before = 0;
    size_t first = 0;
    for (; first + 1 < range.size(); ++first) {
      const uint64_t with_next = before + leaves_of(range[first]);
      if (2 * with_next > all) break;
      before = with_next;
    }
    const size_t most = 2 * before == all ? first : first + 1;
    return {std::max<size_t>(first, 1), std::min(most, range.size() - 1)};
  }

  double cost_of(Range range) const {
    Box box;
    double triangles = 0;
    for (const uint32_t object : range) {
      box.extend(objects_[object].box);
      triangles += static_cast<double>(objects_[object].triangles);
    }
    return expected_cost(box, static_cast<double>(leaves_of(range)), triangles);
  }
  void sort(Range range, int axis) const { std::sort(range.begin(), range.end(), AlongAxis{centers_, axis}); }

  std::span<const ObjectExtent> objects_;
  std::span<const uint64_t> leaves_;
  std::vector<glm::dvec3> centers_;
};

/// Up to four ranges: the halves of the halves.
std::vector<Range> quarters(const Splitter& splitter, Range range) {
  std::vector<Range> quarters;
  for (const Range half : splitter.small_halves(range)) {
    if (half.size() < 2) {
      quarters.push_back(half);
    } else {
      for (const Range quarter : splitter.small_halves(half)) quarters.push_back(quarter);
    }
  }
  return quarters;
}

bool is_mixed(Range range, const std::vector<bool>& moving) {
  return !moving.empty() && !std::ranges::all_of(range, [&](uint32_t object) { return moving[object]; });
}

/// What rests, and what moves.
std::vector<Range> by_moving(Range range, const std::vector<bool>& moving) {
  const auto moves =
      std::stable_partition(range.begin(), range.end(), [&](uint32_t object) { return !moving[object]; });
  return {{range.begin(), moves}, {moves, range.end()}};
}

}  // namespace

std::vector<HierarchyNode> build_hierarchy(std::span<const ObjectExtent> objects, HierarchyKind kind,
                                           std::span<const uint64_t> leaves, std::span<const uint32_t> files,
                                           const std::vector<bool>& moving) {
  const Splitter splitter(objects, leaves);
  const JointRanges joint(objects, leaves, files);
  std::vector<uint32_t> order(objects.size());
  std::iota(order.begin(), order.end(), 0u);
  std::vector<HierarchyNode> nodes(1);
  std::vector<Range> ranges = {order};
  for (size_t i = 0; i < nodes.size(); ++i) {
    const Range range = ranges[i];
    nodes[i].first_place = static_cast<uint32_t>(range.data() - order.data());
    nodes[i].end_place = nodes[i].first_place + static_cast<uint32_t>(range.size());
    if (range.size() == 1) {
      nodes[i].object = range[0];
      continue;
    }
    nodes[i].first_child = static_cast<uint32_t>(nodes.size());
    const std::vector<Range> children = i == 0 && is_mixed(range, moving)     ? by_moving(range, moving)
                                        : kind == HierarchyKind::median_split ? splitter.halves(range)
                                        : joint.is_joint(range)               ? joint.split(range)
                                                                              : quarters(splitter, range);
    for (const Range child : children) {
      HierarchyNode& node = nodes.emplace_back();
      node.parent = static_cast<uint32_t>(i);
      ranges.push_back(child);
    }
    nodes[i].child_count = static_cast<uint32_t>(nodes.size()) - nodes[i].first_child;
  }
  return nodes;
}

}  // namespace triptych
