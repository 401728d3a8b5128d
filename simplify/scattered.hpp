// Small things that stand far apart: bolts on a plate, balls on a lawn. Where they are about as small as a
// pixel, nothing near them hides that their levels cover other pixels than they do.
#pragma once

#include "simplify/surface.hpp"

#include <cstddef>

namespace triptych {

/// Whether the surface covers little of what its box does, both as closed surfaces: a quarter of their areas.
bool is_scattered(const Surface& surface);

/// The level that a chain begins with, where it is not half of the surface.
struct FirstLevel {
  size_t triangles = 0;  ///< about; 0: half of the surface's
  double cover = 1;      ///< what levels cover, of what the surface does
};

/// Of scattered compact things of a few triangles, as stand-ins (simplify/stand_ins.hpp) are: tetrahedra at
/// once. Halving would leave all of them lopsided in the same way, with half as many triangles again. They
/// regain what stand-ins lack.
FirstLevel first_level_of_scattered(const Surface& surface);

}  // namespace triptych
