// Closed bodies that buildings are made of: boxes, and slabs with rectangular holes.
#pragma once

#include "samples/mesh_part.hpp"
#include "samples/rect.hpp"

namespace triptych {

/// The box from `low` to `high` with holes right through it along `axis` (0 x, 1 y, 2 z). A hole's rectangle
/// runs over the two other axes in their order (along z: x and y; along y: x and z; along x: z and y, so that
/// x0..z0 of Rect always is the horizontal one first); holes may reach the border. One closed surface,
/// corners shared, outward.
MeshPart pierced_box(const glm::dvec3& low, const glm::dvec3& high, int axis, const std::vector<Rect>& holes,
                     const glm::dvec3& colour);
MeshPart box(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& colour);
/// Adds the triangles of another part; the colour stays.
void append(MeshPart& part, const MeshPart& other);

}  // namespace triptych
