#include "scene/hierarchy.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace triptych {

namespace {

double half_area(const Box& box) {
  const glm::dvec3 size = box.hi - box.lo;
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

using Range = std::span<uint32_t>;

class Splitter {
 public:
  explicit Splitter(std::span<const Box> boxes) : boxes_(boxes) {
    for (const Box& box : boxes) centers_.push_back((box.lo + box.hi) * 0.5);
  }

  /// Reorders the range and returns the size of its first half: the split of least summed area times count
  /// among all three axes, neither half smaller than an eighth, so that the depth is bounded by log(n) /
  /// log(8/7).
  size_t split(Range range) const {
    const size_t count = range.size(), least = std::max<size_t>(1, count / 8);
    double best_cost = std::numeric_limits<double>::infinity();
    size_t best_split = count / 2;
    int best_axis = 0;
    std::vector<double> area_after(count + 1);
    for (int axis = 0; axis < 3; ++axis) {
      sort(range, axis);
      Box box;
      for (size_t i = count; i-- > 0;) {
        box.extend(boxes_[range[i]]);
        area_after[i] = half_area(box);
      }
      box = {};
      for (size_t i = 1; i < count; ++i) {
        box.extend(boxes_[range[i - 1]]);
        if (i < least || i > count - least) continue;
        const double cost =
            half_area(box) * static_cast<double>(i) + area_after[i] * static_cast<double>(count - i);
        // Of equal costs (a thousand equal boxes) the most balanced split wins.
        const auto imbalance = [&](size_t at) { return at > count - at ? 2 * at - count : count - 2 * at; };
        if (cost < best_cost || (cost == best_cost && imbalance(i) < imbalance(best_split))) {
          best_cost = cost;
          best_split = i;
          best_axis = axis;
        }
      }
    }
    sort(range, best_axis);
    return best_split;
  }

  /// At the median along the longest axis of the centres.
  std::vector<Range> halves(Range range) const {
    Box centers;
    for (const uint32_t object : range) centers.extend(centers_[object]);
    const glm::dvec3 size = centers.hi - centers.lo;
    sort(range, size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2);
    return {range.first(range.size() / 2), range.subspan(range.size() / 2)};
  }

  double area(Range range) const {
    Box box;
    for (const uint32_t object : range) box.extend(boxes_[object]);
    return half_area(box);
  }

 private:
  void sort(Range range, int axis) const {
    std::sort(range.begin(), range.end(), [&](uint32_t a, uint32_t b) {
      return centers_[a][axis] != centers_[b][axis] ? centers_[a][axis] < centers_[b][axis] : a < b;
    });
  }

  std::span<const Box> boxes_;
  std::vector<glm::dvec3> centers_;
};

/// Up to four ranges: halves, and then the halves of the larger halves.
std::vector<Range> children_of(const Splitter& splitter, Range range) {
  std::vector<Range> children = {range};
  while (children.size() < 4) {
    size_t widest = children.size();
    double widest_area = -1;
    for (size_t i = 0; i < children.size(); ++i) {
      if (children[i].size() < 2) continue;
      // Area times count: what a further split can save.
      const double area = splitter.area(children[i]) * static_cast<double>(children[i].size());
      if (area > widest_area) {
        widest_area = area;
        widest = i;
      }
    }
    if (widest == children.size()) break;
    const Range split = children[widest];
    const size_t below = splitter.split(split);
    children[widest] = split.first(below);
    children.insert(children.begin() + static_cast<std::ptrdiff_t>(widest) + 1, split.subspan(below));
  }
  return children;
}

}  // namespace

std::vector<HierarchyNode> build_hierarchy(std::span<const Box> objects, HierarchyKind kind) {
  const Splitter splitter(objects);
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
    const std::vector<Range> children =
        kind == HierarchyKind::median_split ? splitter.halves(range) : children_of(splitter, range);
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
