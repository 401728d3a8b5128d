#include "cells/make_cells.hpp"

#include "base/threads.hpp"
#include "cells/open_area.hpp"
#include "cells/split_space.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// A piece of an inner node's plane, with a cell on each side.
struct Boundary {
  uint32_t below = 0, above = 0;
  int axis = 0;
  double at = 0;
  FlatRectangle face;
};

FlatRectangle face_of(const Box& box, int axis) {
  return {{box.lo[first_axis(axis)], box.lo[second_axis(axis)]},
          {box.hi[first_axis(axis)], box.hi[second_axis(axis)]}};
}

class PortalMaker {
 public:
  PortalMaker(const Walls& walls, CellGraph& graph) : walls_(walls), graph_(graph) {}

  void run() {
    for (const CellGraph::SplitNode& node : graph_.tree) {
      if (node.axis != CellGraph::leaf) add_boundaries(node);
    }
    std::vector<std::vector<FlatRectangle>> open(boundaries_.size());
    parallel_for(boundaries_.size(), [&](size_t i) { open[i] = open_in(boundaries_[i]); });
    std::vector<std::vector<Portal>> of_cells(graph_.cells.size());
    for (size_t i = 0; i < boundaries_.size(); ++i) {
      const Boundary& boundary = boundaries_[i];
      for (const FlatRectangle& opening : open[i]) {
        Portal portal{boundary.above, static_cast<uint8_t>(boundary.axis), true, {}};
        for (auto [corner, at] :
             {std::pair(&portal.box.lo, opening.lo), std::pair(&portal.box.hi, opening.hi)}) {
          (*corner)[boundary.axis] = boundary.at;
          (*corner)[first_axis(boundary.axis)] = at.x;
          (*corner)[second_axis(boundary.axis)] = at.y;
        }
        of_cells[boundary.below].push_back(portal);
        portal.to = boundary.below;
        portal.up = false;
        of_cells[boundary.above].push_back(portal);
      }
    }
    for (size_t cell = 0; cell < of_cells.size(); ++cell) {
      graph_.cells[cell].first_portal = static_cast<uint32_t>(graph_.portals.size());
      graph_.cells[cell].portal_count = static_cast<uint32_t>(of_cells[cell].size());
      graph_.portals.insert(graph_.portals.end(), of_cells[cell].begin(), of_cells[cell].end());
    }
  }

 private:
  /// Cells under a node that touch the plane, from below where `below`.
  std::vector<uint32_t> touching(uint32_t root, int axis, double at, bool below) const {
    std::vector<uint32_t> found, open{root};
    while (!open.empty()) {
      const CellGraph::SplitNode& node = graph_.tree[open.back()];
      open.pop_back();
      if (node.axis != CellGraph::leaf) {
        open.push_back(node.first);
        open.push_back(node.first + 1);
        continue;
      }
      const Box& box = graph_.cells[node.first].box;
      if ((below ? box.hi[axis] : box.lo[axis]) == at) found.push_back(node.first);
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  void add_boundaries(const CellGraph::SplitNode& node) {
    const int axis = static_cast<int>(node.axis);
    const std::vector<uint32_t> above = touching(node.first + 1, axis, node.at, false);
    for (const uint32_t low : touching(node.first, axis, node.at, true)) {
      const FlatRectangle face = face_of(graph_.cells[low].box, axis);
      for (const uint32_t high : above) {
        const FlatRectangle other = face_of(graph_.cells[high].box, axis);
        const FlatRectangle both{glm::max(face.lo, other.lo), glm::min(face.hi, other.hi)};
        if (both.lo.x < both.hi.x && both.lo.y < both.hi.y)
          boundaries_.push_back({low, high, axis, node.at, both});
      }
    }
  }

  std::vector<FlatRectangle> open_in(const Boundary& boundary) const {
    const WallPlane* const plane = walls_at(walls_, boundary.axis, boundary.at);
    const std::span<const WallTriangle> triangles =
        plane ? std::span<const WallTriangle>(plane->triangles) : std::span<const WallTriangle>();
    return open_area(boundary.face, triangles, walls_.tolerance);
  }

  const Walls& walls_;
  CellGraph& graph_;
  std::vector<Boundary> boundaries_;
};

}  // namespace

void add_portals(const Walls& walls, CellGraph& graph) { PortalMaker(walls, graph).run(); }

CellGraph make_cells(const Walls& walls, const Box& model) {
  CellGraph graph = split_space(walls, model);
  add_portals(walls, graph);
  return graph;
}

CellGraph make_cells(const Pack& pack) {
  const Skeleton& skeleton = pack.skeleton();
  return make_cells(find_walls(pack), skeleton.lattice().box(skeleton.scene_nodes[0].box));
}

}  // namespace triptych
