// How a person walks from room to room of one storey, and where they look.
#pragma once

#include "samples/camera_paths.hpp"
#include "samples/free_space.hpp"
#include "samples/random.hpp"

#include <string>
#include <vector>

namespace triptych {

/// Between who walks and everything else, metres.
inline constexpr double walking_clearance = 0.3;

/// A room worth a visit.
struct Stop {
  size_t room = 0;  ///< its number, of which the caller knows more
  Rect area;
  glm::dvec2 place{0};   ///< free, and with a way to others
  bool through = false;  ///< it has two doors at least
};

/// Heading 0 is east, a quarter turn south; the slope is how much higher the target lies 1 m ahead.
CameraFrame looking(const glm::dvec3& eye, double heading, double slope = 0);

/// A walk at 1.25 m a second, 30 frames a second, from a room through one with two doors to a third where
/// there is such a way, turning at most 0.8 degrees a frame. Error, which names `place`, if no way between
/// the rooms is long enough.
CameraFrames walk_through(const std::vector<Stop>& stops, const FreeSpace& space, size_t frames,
                          double eye_level, const std::string& place, const Random& random);

}  // namespace triptych
