// The four camera paths through a sample building.
#pragma once

#include "samples/building/floor_plan.hpp"
#include "samples/building/furnisher.hpp"
#include "samples/camera_paths.hpp"
#include "samples/random.hpp"
#include "samples/walking.hpp"

#include <vector>

namespace triptych {

/// 300 frames of a person who walks at 1.25 m a second, 30 frames a second: from room to room by open doors,
/// at least 0.3 m from everything, turning at most 0.8 degrees a frame. Error if the building is so full that
/// no path is long enough.
CameraFrames make_walk(const FloorPlan& plan, const std::vector<FurniturePlacement>& placements,
                       const Random& random);
/// 300 frames of about 1 m: from outside through the corridors, up the hall, out by the roof and around; goes
/// through walls where it must.
CameraFrames make_fly(const FloorPlan& plan);
/// 120 frames on one spot in a furnished room, turning by 3 degrees each.
CameraFrames make_spin(const FloorPlan& plan, const std::vector<FurniturePlacement>& placements,
                       const Random& random);
/// 60 views from random places, three of four in rooms, the others outside.
CameraFrames make_jump(const FloorPlan& plan, const std::vector<FurniturePlacement>& placements,
                       const Random& random);

}  // namespace triptych
