#include "simplify/neighbours.hpp"

#include "base/threads.hpp"
#include "simplify/median_split.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>

namespace triptych {

namespace {

/// The middle of each range of `order_` is its root, split along the axis in `axes_`.
class Tree {
 public:
  explicit Tree(std::span<const glm::dvec3> points)
      : points_(points), order_(points.size()), axes_(points.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    build(0, order_.size());
  }

  std::vector<uint32_t> nearest(uint32_t index, uint32_t count) const {
    std::vector<Candidate> heap;
    search(0, order_.size(), index, count, heap);
    std::sort_heap(heap.begin(), heap.end());
    std::vector<uint32_t> found;
    for (const Candidate& candidate : heap) found.push_back(candidate.index);
    return found;
  }

 private:
  struct Candidate {
    double distance;  ///< squared
    uint32_t away;    ///< difference of its index and that of the point
    uint32_t index;
    bool operator<(const Candidate& other) const {
      return std::tie(distance, away, index) < std::tie(other.distance, other.away, other.index);
    }
  };

  void build(size_t first, size_t end) {
    if (end - first < 2) return;
    const size_t middle = (first + end) / 2;
    axes_[middle] =
        static_cast<uint8_t>(split_at_median(std::span(order_).subspan(first, end - first), points_));
    build(first, middle);
    build(middle + 1, end);
  }

  void search(size_t first, size_t end, uint32_t index, uint32_t count, std::vector<Candidate>& heap) const {
    if (first >= end) return;
    const size_t middle = (first + end) / 2;
    const uint32_t other = order_[middle];
    if (other != index) {
      const glm::dvec3 apart = points_[other] - points_[index];
      const Candidate candidate{glm::dot(apart, apart), index > other ? index - other : other - index, other};
      if (heap.size() < count) {
        heap.push_back(candidate);
        std::push_heap(heap.begin(), heap.end());
      } else if (count > 0 && candidate < heap.front()) {
        std::pop_heap(heap.begin(), heap.end());
        heap.back() = candidate;
        std::push_heap(heap.begin(), heap.end());
      }
    }
    const int axis = axes_[middle];
    const double beyond = points_[index][axis] - points_[other][axis];
    const bool low_first = AlongAxis{points_, axis}(index, other);
    search(low_first ? first : middle + 1, low_first ? middle : end, index, count, heap);
    if (heap.size() < count || beyond * beyond < heap.front().distance) {
      search(low_first ? middle + 1 : first, low_first ? end : middle, index, count, heap);
    }
  }

  std::span<const glm::dvec3> points_;
  std::vector<uint32_t> order_;
  std::vector<uint8_t> axes_;
};

}  // namespace

std::vector<std::vector<uint32_t>> nearest_neighbours(std::span<const glm::dvec3> points, uint32_t count) {
  const Tree tree(points);
  std::vector<std::vector<uint32_t>> neighbours(points.size());
  parallel_for(points.size(),
               [&](size_t i) { neighbours[i] = tree.nearest(static_cast<uint32_t>(i), count); });
  return neighbours;
}

}  // namespace triptych
