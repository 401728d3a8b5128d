// Small things that stand far apart: bolts on a plate, balls on a lawn. Where they are about as small as a
// pixel, nothing near them hides that their levels cover other pixels than they do.
#pragma once

#include "simplify/component_covers.hpp"

#include <cstddef>
#include <vector>

namespace triptych {

/// The components of a surface that are small beside its box.
struct SmallThings {
  std::vector<Cover> covers;
  size_t triangles = 0;
};

/// Those of a surface, if they cover little of what its box does, both as closed surfaces: a quarter of their
/// areas. None otherwise.
SmallThings scattered_things(const Surface& surface);

/// The level that a chain begins with, where it is not half of the surface.
struct FirstLevel {
  size_t triangles = 0;  ///< about; 0: half of the surface's
  double cover = 1;      ///< what levels cover, of what the surface does
};

/// Of scattered compact things of a few triangles, as stand-ins (simplify/stand_ins.hpp) are: tetrahedra at
/// once. Halving would leave all of them lopsided in the same way, with half as many triangles again. They
/// regain what stand-ins lack. What they stand on keeps its triangles.
FirstLevel first_level_of_scattered(const Surface& surface);

}  // namespace triptych
