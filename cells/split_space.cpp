#include "cells/split_space.hpp"

#include "cells/open_area.hpp"

#include <algorithm>
#include <cmath>

namespace triptych {

namespace {

constexpr double least_share = 0.1;   ///< of the cross-section that walls of a plane must cover
constexpr size_t most_cells = 50000;  ///< then space is not divided further

FlatRectangle cross_section(const Box& box, int axis) {
  return {{box.lo[first_axis(axis)], box.lo[second_axis(axis)]},
          {box.hi[first_axis(axis)], box.hi[second_axis(axis)]}};
}

/// The walls of one plane that reach into a node's box.
struct PlaneShare {
  const WallPlane* plane = nullptr;
  std::vector<WallTriangle> triangles;
};

class SpaceSplitter {
 public:
  SpaceSplitter(const Walls& walls, const Box& model) : walls_(walls) {
    const double margin = 1e-3 * diagonal(model) + 16 * walls.tolerance;
    graph_.box = {model.lo - margin, model.hi + margin};
    graph_.wall_triangles = walls.triangles;
  }

  CellGraph run() {
    std::vector<PlaneShare> shares;
    for (const WallPlane& plane : walls_.planes) shares.push_back({&plane, plane.triangles});
    graph_.tree.emplace_back();
    divide(0, graph_.box, std::move(shares));
    return std::move(graph_);
  }

 private:
  void divide(uint32_t node, const Box& box, std::vector<PlaneShare> shares) {
    const PlaneShare* best = nullptr;
    double best_share = least_share;
    for (const PlaneShare& share : shares) {
      const double of_section = share_of(share, box);
      if (of_section > best_share) {
        best_share = of_section;
        best = &share;
      }
    }
    if (best == nullptr || graph_.cells.size() >= most_cells) {
      graph_.tree[node].first = static_cast<uint32_t>(graph_.cells.size());
      graph_.cells.push_back({box, 0, 0});
      return;
    }
    const int axis = best->plane->axis;
    const double at = best->plane->at;
    const uint32_t first = static_cast<uint32_t>(graph_.tree.size());
    graph_.tree[node] = {static_cast<uint32_t>(axis), first, at};
    graph_.tree.resize(first + 2);
    Box below = box, above = box;
    below.hi[axis] = above.lo[axis] = at;
    std::vector<PlaneShare> of_below = within(shares, below), of_above = within(shares, above);
    shares.clear();
    divide(first, below, std::move(of_below));
    divide(first + 1, above, std::move(of_above));
  }

  /// How much of the box's cross-section the plane's walls cover; 0 where it would cut off next to nothing.
  double share_of(const PlaneShare& share, const Box& box) const {
    const int axis = share.plane->axis;
    const double least = 4 * walls_.tolerance, at = share.plane->at;
    if (at < box.lo[axis] + least || at > box.hi[axis] - least) return 0;
    const FlatRectangle section = cross_section(box, axis);
    const double whole = section.size().x * section.size().y;
    return whole > 0 ? std::min(1.0, covered_area(section, share.triangles) / whole) : 0;
  }

  static std::vector<PlaneShare> within(const std::vector<PlaneShare>& shares, const Box& box) {
    std::vector<PlaneShare> inside;
    for (const PlaneShare& share : shares) {
      const int axis = share.plane->axis;
      if (share.plane->at <= box.lo[axis] || share.plane->at >= box.hi[axis]) continue;
      const FlatRectangle section = cross_section(box, axis);
      PlaneShare kept{share.plane, {}};
      for (const WallTriangle& triangle : share.triangles) {
        const glm::dvec2 lo =
            glm::min(glm::min(triangle.corners[0], triangle.corners[1]), triangle.corners[2]);
        const glm::dvec2 hi =
            glm::max(glm::max(triangle.corners[0], triangle.corners[1]), triangle.corners[2]);
        if (lo.x < section.hi.x && hi.x > section.lo.x && lo.y < section.hi.y && hi.y > section.lo.y)
          kept.triangles.push_back(triangle);
      }
      if (!kept.triangles.empty()) inside.push_back(std::move(kept));
    }
    return inside;
  }

  const Walls& walls_;
  CellGraph graph_;
};

}  // namespace

CellGraph split_space(const Walls& walls, const Box& model) { return SpaceSplitter(walls, model).run(); }

const WallPlane* walls_at(const Walls& walls, int axis, double at) {
  const auto found = std::lower_bound(walls.planes.begin(), walls.planes.end(), std::pair(axis, at),
                                      [](const WallPlane& plane, const std::pair<int, double>& sought) {
                                        return std::pair(plane.axis, plane.at) < sought;
                                      });
  const bool is_there = found != walls.planes.end() && found->axis == axis && found->at == at;
  return is_there ? &*found : nullptr;
}

}  // namespace triptych
