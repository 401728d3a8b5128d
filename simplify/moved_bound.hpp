// The bound of a level whose points were moved after it was made.
#pragma once

#include "simplify/surface.hpp"

#include <glm/vec3.hpp>
#include <span>

namespace triptych {

/// How far the level is from its source, both ways, in lattice steps. bound: how far it was. before: where
/// its points were, by their indices. errors: for each triangle how far its points were from those of the
/// source that they stand for, where each point of the source stands for one; any other number of them: not
/// known. No point is further than its triangle was, and that triangle's furthest corner moved; nor further
/// than the bound and the furthest of all ways.
double moved_bound(double bound, const Surface& level, std::span<const glm::ivec3> before,
                   std::span<const double> errors);

}  // namespace triptych
