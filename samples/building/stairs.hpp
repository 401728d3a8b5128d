// Stairs with a half turn from one storey to the next.
#pragma once

#include "samples/building/floor_plan.hpp"
#include "samples/mesh_part.hpp"

namespace triptych {

/// Two flights and a landing below the opening of the storey above: up along its outer side to the north,
/// back along its inner side; y = 0 is the lower floor. `west`: the opening's larger x is its outer side.
std::vector<MeshPart> stair_flights(const Rect& opening, bool west);

}  // namespace triptych
