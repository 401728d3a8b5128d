// Where three or four points cover most for how far they are from their middle.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace triptych {

/// For three or four points of small things directions of length 1 that are as far apart as they can be:
/// those of an equilateral triangle in their plane, or of a tetrahedron, turned so that the points go a short
/// way there; the winding of their triangles stays.
std::vector<glm::dvec3> spread_corners(std::span<const glm::dvec3> points);

}  // namespace triptych
