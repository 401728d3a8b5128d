// One track of a motion: its value at a time, and what bounds its values between keys.
#pragma once

#include "scene/motion.hpp"

#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

namespace triptych {

/// At a time (seconds); of tracks of three components the last one is 0. Quaternions have length 1; linear
/// ones turn at even speed along the shorter way (slerp).
glm::dvec4 value_at(const MotionTrack& track, double time);

/// Holds all values of a track of three components.
Box values_box(const MotionTrack& track);

/// Quaternions that lie within a distance of one of length 1, as points of the sphere.
struct QuaternionBall {
  glm::dvec4 middle;
  double radius = 0;  ///< 2 or more: all there are
};

/// Of a track of quaternions: each of its values is in one of them. They are small where that takes no more
/// than some hundred for each key.
std::vector<QuaternionBall> quaternion_balls(const MotionTrack& track);

}  // namespace triptych
