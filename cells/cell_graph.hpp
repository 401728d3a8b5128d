// Rooms and the openings between them: a subdivision of the model's box along its walls, and what can be
// looked through between its cells (berkeley-walkthrough-1996 §3.1).
#pragma once

#include "scene/box.hpp"

#include <cstdint>
#include <vector>

namespace triptych {

/// A part of the boundary of two cells that no wall covers, or more than that.
struct Portal {
  uint32_t to = 0;   ///< the cell behind it
  uint8_t axis = 0;  ///< that it is perpendicular to
  bool up = false;   ///< whether the cell behind lies in the axis' direction
  Box box;           ///< flat, model units
};

/// A box of the subdivision with its ways out.
struct SpaceCell {
  Box box;  ///< model units
  uint32_t first_portal = 0, portal_count = 0;
};

/// A k-D tree whose leaves are cells, and a graph of portals over them. A line that leaves a cell anywhere
/// but through one of its portals meets a wall there, or leaves the model's box.
class CellGraph {
 public:
  static constexpr uint32_t leaf = 3;  ///< in place of an axis

  /// Inner: children are `first` (below the plane) and `first` + 1; leaf: `first` is its cell.
  struct SplitNode {
    uint32_t axis = leaf;
    uint32_t first = 0;
    double at = 0;
  };

  std::vector<SplitNode> tree;  ///< 0 is the root, whose box is `box`
  std::vector<SpaceCell> cells;
  std::vector<Portal> portals;  ///< cell by cell
  Box box;                      ///< of all cells; holds the model
  uint64_t wall_triangles = 0;  ///< that were found, of full detail

  /// Calls found(cell) for every cell that the box touches, until one call returns true; whether one did.
  /// open: room for the walk, kept by the caller.
  template <typename Found>
  bool any_touched(const Box& touching, std::vector<uint32_t>& open, const Found& found) const {
    open.assign(1, 0);
    while (!open.empty()) {
      const SplitNode& node = tree[open.back()];
      open.pop_back();
      if (node.axis == leaf) {
        if (found(node.first)) return true;
        continue;
      }
      const int axis = static_cast<int>(node.axis);
      if (touching.hi[axis] >= node.at) open.push_back(node.first + 1);
      if (touching.lo[axis] <= node.at) open.push_back(node.first);
    }
    return false;
  }
};

}  // namespace triptych
