#include "scene/motion.hpp"
#include "scene/motion_tracks.hpp"
#include "scene/transforms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/mat3x3.hpp>

namespace triptych {

namespace {

/// More than rounding may move anything, as a share of how large the numbers are.
constexpr double rounding = 1e-11;

Box with_margin(const Box& box) {
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis)
    largest = std::max({largest, std::abs(box.lo[axis]), std::abs(box.hi[axis])});
  return {box.lo - largest * rounding, box.hi + largest * rounding};
}

Box scales_of(const Motion& motion, const MotionJoint& joint) {
  return joint.scale_track == MotionJoint::none ? Box{joint.scale, joint.scale}
                                                : values_box(motion.tracks[joint.scale_track]);
}

Box scaled(const Box& box, const Box& scales) {
  Box result;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [least, most] = std::minmax({box.lo[axis] * scales.lo[axis], box.lo[axis] * scales.hi[axis],
                                            box.hi[axis] * scales.lo[axis], box.hi[axis] * scales.hi[axis]});
    result.lo[axis] = least;
    result.hi[axis] = most;
  }
  return result;
}

/// Two unit quaternions that are e apart turn a point to places that are at most 2·e of its distance from
/// the origin apart: they differ by the angle 4·asin(e/2), whose chord is 2·e·√(1 − e²/4).
Box turned(const Box& box, const MotionTrack& track) {
  double farthest = 0;
  for (int corner = 0; corner < 8; ++corner) farthest = std::max(farthest, glm::length(box.corner(corner)));
  Box result;
  for (const QuaternionBall& ball : quaternion_balls(track)) {
    const double moved = 2 * ball.radius * farthest;
    Box there = placed_box(transform_of_parts(glm::dvec3(0), ball.middle, glm::dvec3(1)), box);
    there = {glm::max(there.lo - moved, glm::dvec3(-farthest)),
             glm::min(there.hi + moved, glm::dvec3(farthest))};
    result.extend(there);
  }
  return result;
}

Box turned(const Motion& motion, const MotionJoint& joint, const Box& box) {
  if (joint.rotation_track != MotionJoint::none) return turned(box, motion.tracks[joint.rotation_track]);
  return placed_box(transform_of_parts(glm::dvec3(0), joint.rotation, glm::dvec3(1)), box);
}

Box moved(const Motion& motion, const MotionJoint& joint, const Box& box) {
  if (joint.translation_track == MotionJoint::none)
    return {box.lo + joint.translation, box.hi + joint.translation};
  const Box by = values_box(motion.tracks[joint.translation_track]);
  return {box.lo + by.lo, box.hi + by.hi};
}

}  // namespace

Box swept_box(const Motion& motion, uint32_t joint, const Box& box) {
  Box swept = box;
  for (uint32_t at = joint; at != MotionJoint::none; at = motion.joints[at].parent) {
    const MotionJoint& of = motion.joints[at];
    // Each property over all times by itself: they may be of clips of different lengths.
    swept = with_margin(scaled(swept, scales_of(motion, of)));
    swept = with_margin(turned(motion, of, swept));
    swept = with_margin(moved(motion, of, swept));
    swept = with_margin(placed_box(of.before, swept));
  }
  return swept;
}

double largest_stretch(const Motion& motion, uint32_t joint) {
  double stretch = 1;
  for (uint32_t at = joint; at != MotionJoint::none; at = motion.joints[at].parent) {
    const Box scales = scales_of(motion, motion.joints[at]);
    double most = 0;
    for (int axis = 0; axis < 3; ++axis)
      most = std::max({most, std::abs(scales.lo[axis]), std::abs(scales.hi[axis])});
    stretch *= most * largest_stretch(motion.joints[at].before) * (1 + rounding);
  }
  return stretch;
}

}  // namespace triptych
