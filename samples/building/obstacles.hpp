// What stands in the way of who walks through the sample building.
#pragma once

#include "samples/building/floor_plan.hpp"
#include "samples/building/furnisher.hpp"

#include <vector>

namespace triptych {

/// What a person of 1.8 metres cannot walk through on that floor: walls but for doors and passages, open door
/// leaves, openings in the floor, stairs, and furniture that stands or hangs in the way.
std::vector<Rect> obstacles(const FloorPlan& plan, const std::vector<FurniturePlacement>& placements,
                            int floor);

}  // namespace triptych
