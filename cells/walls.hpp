// What may be a wall: large opaque triangles of full detail that lie across an axis.
#pragma once

#include "scene/pack.hpp"

#include <array>
#include <glm/vec2.hpp>
#include <vector>

namespace triptych {

/// In the plane that it lies in: the axes after the plane's, in turn (x: y and z; y: z and x; z: x and y).
struct WallTriangle {
  std::array<glm::dvec2, 3> corners;  ///< model units, counter-clockwise
};

/// All wall triangles in one plane.
struct WallPlane {
  int axis = 0;
  double at = 0;  ///< along the axis, model units
  std::vector<WallTriangle> triangles;
  double area = 0;
};

struct Walls {
  std::vector<WallPlane> planes;  ///< by axis, ascending
  double tolerance = 0;           ///< how far corners may be off their plane, model units
  uint64_t triangles = 0;
};

/// The axes of a plane perpendicular to `axis`.
inline int first_axis(int axis) { return (axis + 1) % 3; }
inline int second_axis(int axis) { return (axis + 2) % 3; }

/// Reads what the leaves of the pack have at full detail, without what moves, is seen through, or is small
/// against the model. Error as Pack::read_chunk().
Walls find_walls(const Pack& pack);

}  // namespace triptych
