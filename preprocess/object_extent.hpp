// What partition, clustering and hierarchy know of an object.
#pragma once

#include "scene/box.hpp"

#include <cstdint>

namespace triptych {

struct ObjectExtent {
  Box box;
  uint64_t triangles = 0;
};

/// What a test and a draw cost beside the triangles, in triangles.
constexpr double drawable_cost = 32;

/// What drawing it is expected to cost: how often its box is seen, as the surface says, times what it then
/// costs (the argument of the surface area heuristic: MacDonald and Booth, Heuristics for ray tracing using
/// space subdivision, 1990). Square units times triangles.
inline double expected_cost(const Box& box, double drawables, double triangles) {
  return half_area(box) * (drawables * drawable_cost + triangles);
}

}  // namespace triptych
