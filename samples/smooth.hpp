// Shading normals of meshes whose facets stand for something round.
#pragma once

#include "samples/mesh_part.hpp"

namespace triptych {

/// The same triangles, each with corners of its own, whose normals are the means of those of all facets at
/// the place that are no further off than `crease_degrees` from their own facet's, by area.
MeshPart with_smooth_normals(const MeshPart& part, double crease_degrees = 50);

}  // namespace triptych
