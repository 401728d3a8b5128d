// Where vertex clustering moves points to: in each cell of a grid, the point that fits the surface best.
#pragma once

#include "simplify/layered_planes.hpp"
#include "simplify/surface.hpp"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace triptych {

/// The planes of a surface's triangles, shared by clusterings with different cell sizes.
class TrianglePlanes {
 public:
  struct Plane {
    glm::dvec3 normal;  ///< of length 1
    double doubled_area;
  };
  /// The surface has no degenerate triangle.
  explicit TrianglePlanes(const Surface& surface);
  const Plane& operator[](size_t triangle) const { return planes_[triangle]; }
  double area(size_t triangle) const { return planes_[triangle].doubled_area / 2; }

 private:
  std::vector<Plane> planes_;
};

/// For each point of the surface the one that it moves to, and how far the furthest goes.
struct CellMoves {
  std::vector<uint32_t> images;
  double furthest = 0;     ///< lattice steps
  double planes_left = 0;  ///< the size of the largest layered plane that a point leaves, lattice steps
};

/// Each point moves to the point of its cell that fits the planes around the cell's points best (after
/// Lindstrom, Out-of-core simplification of large polygonal models, 2000, but only to existing points);
/// locked points stay. `cell`: the edge of a cell, lattice steps; `planes`: those of the surface. Layered
/// planes in which a point of a cell lies, and which are larger than two cells, divide it: points in front of
/// such a plane, in it and behind it go to points of their own. sunk: sunk_points(), to which a cell's points
/// move only if it has no others.
CellMoves move_to_cells(const Surface& surface, const TrianglePlanes& planes, std::span<const uint8_t> locked,
                        double cell, const LayeredPlanes& layered, std::span<const uint8_t> sunk = {});

}  // namespace triptych
