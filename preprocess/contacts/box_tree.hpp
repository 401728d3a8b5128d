// Which of many boxes overlap a given one: a bounding volume tree split at medians.
#pragma once

#include "scene/box.hpp"

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
  /// Boxes that are not empty; there may be none.
  explicit BoxTree(std::vector<Box> boxes);

  /// Calls visit(index) for each of the boxes that shares a point with this one, in an order that depends on
  /// the boxes alone.
  template <typename Visit>
  void visit(const Box& box, const Visit& visit) const {
    if (nodes_.empty()) return;
    uint32_t node = 0;
    for (;;) {
      const Node& here = nodes_[node];
      const bool inside = overlap(here.box, box);
      if (inside && here.count > 0) {
        for (uint32_t i = here.first; i < here.first + here.count; ++i) {
          if (overlap(boxes_[order_[i]], box)) visit(order_[i]);
        }
      }
      node = inside && here.count == 0 ? node + 1 : here.behind;
      if (node == end) return;
    }
  }

 private:
  static constexpr uint32_t end = 0xffffffffu;
  struct Node {
    Box box;
    uint32_t first = 0, count = 0;  ///< of a leaf: in order_; an inner node has count 0, and its first child
                                    ///< follows it
    uint32_t behind = end;          ///< the node that comes after this one's subtree
  };
  void build(uint32_t first, uint32_t last, std::vector<glm::dvec3>& centers);

  std::vector<Box> boxes_;
  std::vector<uint32_t> order_;
  std::vector<Node> nodes_;  ///< depth first
};

}  // namespace triptych
