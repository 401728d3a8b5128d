// Which of many boxes overlap a given one: a bounding volume tree split at medians.
#pragma once

#include "scene/box.hpp"
#include "scene/ray.hpp"

#include <cstdint>
#include <vector>

namespace triptych {

inline bool overlap(const Box& a, const Box& b) {
  return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y && a.lo.z <= b.hi.z &&
         b.lo.z <= a.hi.z;
}

/// The box with a margin all round.
inline Box grown(Box box, double margin) {
  box.lo -= margin;
  box.hi += margin;
  return box;
}

class BoxTree {
 public:
  /// Boxes that are not empty; there may be none. ranks: for visit_below(); empty if it is not used.
  explicit BoxTree(std::vector<Box> boxes, std::vector<uint32_t> ranks = {});

  /// Calls visit(index) for each of the boxes that shares a point with this one, in an order that depends on
  /// the boxes alone.
  template <typename Visit>
  void visit(const Box& box, const Visit& visit) const {
    walk(box, end, [&](uint32_t index) {
      visit(index);
      return true;
    });
  }
  /// The same until visit(index) returns false.
  template <typename Visit>
  void visit_while(const Box& box, const Visit& visit) const {
    walk(box, end, visit);
  }
  /// The same for boxes that the ray meets; visit() may shorten the ray, by its `most`. margin: of boxes.
  template <typename Visit>
  void visit(const RaySpan& ray, double margin, const Visit& visit) const {
    uint32_t node = nodes_.empty() ? end : 0;
    while (node != end) {
      const Node& here = nodes_[node];
      const bool inside = ray.meets(grown(here.box, margin));
      if (inside) {
        for (uint32_t i = here.first; i < here.first + here.count; ++i) {
          if (ray.meets(grown(boxes_[order_[i]], margin))) visit(order_[i]);
        }
      }
      node = inside && here.count == 0 ? node + 1 : here.behind;
    }
  }
  /// The same for those of a lower rank, until visit(index) returns false.
  template <typename Visit>
  void visit_below(const Box& box, uint32_t rank, const Visit& visit) const {
    walk(box, rank, [&](uint32_t index) { return ranks_[index] >= rank || visit(index); });
  }

 private:
  static constexpr uint32_t end = 0xffffffffu;
  struct Node {
    Box box;
    uint32_t first = 0, count = 0;  ///< of a leaf: in order_; an inner node has count 0, and its first child
                                    ///< follows it
    uint32_t least_rank = 0;
    uint32_t behind = end;  ///< the node that comes after this one's subtree
  };
  template <typename Visit>
  void walk(const Box& box, uint32_t rank, const Visit& visit) const {
    uint32_t node = nodes_.empty() ? end : 0;
    while (node != end) {
      const Node& here = nodes_[node];
      const bool inside = here.least_rank < rank && overlap(here.box, box);
      if (inside) {
        for (uint32_t i = here.first; i < here.first + here.count; ++i) {
          if (overlap(boxes_[order_[i]], box) && !visit(order_[i])) return;
        }
      }
      node = inside && here.count == 0 ? node + 1 : here.behind;
    }
  }
  void build(uint32_t first, uint32_t last, std::vector<glm::dvec3>& centers);

  std::vector<Box> boxes_;
  std::vector<uint32_t> ranks_;
  std::vector<uint32_t> order_;
  std::vector<Node> nodes_;  ///< depth first
};

}  // namespace triptych
