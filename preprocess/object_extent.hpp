// What partitioning, clustering and the hierarchy need to know of an object.
#pragma once

#include "scene/box.hpp"

#include <cstdint>

namespace triptych {

struct ObjectExtent {
  Box box;
  uint64_t triangles = 0;
};

/// The cost of a test and a draw call beside the triangles, in triangles.
constexpr double drawable_cost = 32;

/// The expected cost of drawing: the chance that the box is seen, which goes with its surface, times the cost
/// of drawing its content (the argument of the surface area heuristic: MacDonald and Booth, Heuristics for
/// ray tracing using space subdivision, 1990). Square units times triangles.
inline double expected_cost(const Box& box, double drawables, double triangles) {
  return half_area(box) * (drawables * drawable_cost + triangles);
}

}  // namespace triptych
