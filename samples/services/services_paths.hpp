// The camera paths of the sample `services`.
#pragma once

#include "samples/camera_paths.hpp"
#include "samples/rect.hpp"
#include "samples/services/hospital_plan.hpp"

#include <vector>

namespace triptych {

/// What the paths need to know of a storey.
struct WalkableStorey {
  std::vector<HospitalRoom> rooms;
  std::vector<Rect> obstacles;
};

/// 600 frames, 25 m at 1.25 m a second through the storey without ceilings next to the middle: from a room
/// through another one or along the corridors to a third, at eye height, 0.3 m from everything. Error if the
/// storey is so full that no way is long enough.
CameraFrames services_walk(const std::vector<WalkableStorey>& storeys, const Random& random);
/// 300 frames of about 1 m: from outside through both long corridors of that storey, around and over the
/// roof.
CameraFrames services_fly(int storeys);
/// 120 frames in a ward of that storey, turning by 3 degrees each.
CameraFrames services_spin(const std::vector<WalkableStorey>& storeys);
/// 60 views from random places, three of four in rooms and corridors, the others outside.
CameraFrames services_jump(const std::vector<WalkableStorey>& storeys, Random random);
/// 300 frames once around the building from outside, near and far.
CameraFrames services_orbit(int storeys);

}  // namespace triptych
