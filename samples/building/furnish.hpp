// Furnishes a building: every room by the template of its type, as many placements as wanted, a mean triangle
// count.
#pragma once

#include "samples/building/furnisher.hpp"

namespace triptych {

struct Furnishing {
  std::vector<FurniturePlacement> placements;  ///< by room
  uint64_t triangles = 0;                      ///< placed
};

/// Furnishes every room and keeps the most important placements of each, in proportion, until there are
/// `wanted` of them (fewer only if the rooms hold no more). Models with many triangles are chosen less often,
/// as far as that is needed to come near `wanted * mean_triangles` placed triangles.
Furnishing furnish_building(const Furniture& furniture, const RolePools& pools,
                            const std::vector<uint64_t>& triangles, const FloorPlan& plan, size_t wanted,
                            double mean_triangles, const Random& random);

/// The placements of one room by the template of its type, the most important ones first; nothing stands on
/// something that comes later.
std::vector<FurniturePlacement> furnish_room(const Supply& supply, const FloorPlan& plan, int room,
                                             const Random& random);

}  // namespace triptych
