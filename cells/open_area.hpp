// What of a rectangle triangles in its plane leave open.
#pragma once

#include "cells/walls.hpp"

#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace triptych {

/// In a plane, corners included.
struct FlatRectangle {
  glm::dvec2 lo{0}, hi{0};
  glm::dvec2 size() const { return hi - lo; }
};

/// Rectangles within `of` that hold all of it that no triangle covers, as long as that is wider than `least`;
/// they may hold more. Triangles that share a side leave nothing open along it, nor do those that come
/// nearer to each other than `least`.
std::vector<FlatRectangle> open_area(const FlatRectangle& of, std::span<const WallTriangle> triangles,
                                     double least);

/// The area of the rectangle that the triangles cover, counted once for each of them.
double covered_area(const FlatRectangle& of, std::span<const WallTriangle> triangles);

}  // namespace triptych
