// Seams within a mesh: where it ends beside itself, nearer than files of single precision can tell.
#pragma once

#include "preprocess/closed_groups.hpp"
#include "simplify/surface.hpp"

#include <cstdint>

namespace triptych {

struct ClosedSeams {
  uint64_t points = 0;  ///< that became one with another
  uint32_t moved = 0;   ///< how far one of them moved at most, lattice steps, rounded up
};

/// Points of open edges that lie within `contact_steps` of each other become one, or a level of detail would
/// open the gap between them. Not where a triangle would lose its area or turn around. closed: of the
/// surface, whose triangles have no open edges; it holds no longer if any points became one.
ClosedSeams close_seams(Surface& surface, const ClosedTriangles& closed);

}  // namespace triptych
