// Which triangles show the outside of something solid: from outside of it, their backs are never seen.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace triptych {

/// For each triangle whether it is proven to belong to a surface that is closed, that meets itself in corners
/// and edges at most, and whose triangles go round counter-clockwise where they are seen from outside. Points
/// with one place are one. Solids that touch, in corners, edges or faces, are each for itself; of a
/// hollow one it is the outer surface. The proof is exact, but does not find every such surface: it is given
/// up where too many boxes of triangles overlap. points: within ±2^29. indices: three a triangle.
/// seen_through: of each triangle, or empty: through such a one the backs of the others are seen, so that its
/// surface is not outward.
std::vector<bool> outward_triangles(std::span<const glm::ivec3> points, std::span<const uint32_t> indices,
                                    const std::vector<bool>& seen_through = {});

}  // namespace triptych
