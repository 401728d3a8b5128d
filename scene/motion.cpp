#include "scene/motion.hpp"

#include "base/error.hpp"
#include "scene/motion_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

namespace triptych {

namespace {

glm::dvec3 vector_of(const Motion& motion, uint32_t track, const glm::dvec3& otherwise, double time) {
  return track == MotionJoint::none ? otherwise : glm::dvec3(value_at(motion.tracks[track], time));
}

Affine local_transform(const Motion& motion, const MotionJoint& joint, double time) {
  const glm::dvec4 rotation = joint.rotation_track == MotionJoint::none
                                  ? joint.rotation
                                  : value_at(motion.tracks[joint.rotation_track], time);
  const Affine moved = transform_of_parts(vector_of(motion, joint.translation_track, joint.translation, time),
                                          rotation, vector_of(motion, joint.scale_track, joint.scale, time));
  return joint.before * glm::dmat4(moved);
}

bool all_finite(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

void check_track(const MotionTrack& track, const std::string& place) {
  if (track.interpolation > Interpolation::cubic_spline)
    fail(place, "interpolates in a way that is not known");
  if (track.components != 3 && track.components != 4)
    fail(place, "has values of {} numbers", track.components);
  if (track.times.empty()) fail(place, "has no keys");
  const size_t values_of_key = track.interpolation == Interpolation::cubic_spline ? 3 : 1;
  if (track.values.size() != track.times.size() * values_of_key * track.components)
    fail(place, "has {} numbers for {} keys", track.values.size(), track.times.size());
  if (!all_finite(track.times) || track.times.front() < 0 ||
      !std::ranges::is_sorted(track.times, std::less_equal<>()))
    fail(place, "has times that do not increase from 0 on");
  if (!(track.length >= track.times.back() && std::isfinite(track.length)))
    fail(place, "has keys after its end");
  if (!all_finite(track.values)) fail(place, "has values that are not finite");
}

}  // namespace

Affine transform_of_parts(const glm::dvec3& translation, const glm::dvec4& rotation,
                          const glm::dvec3& scale) {
  const double length = std::sqrt(rotation.x * rotation.x + rotation.y * rotation.y +
                                  rotation.z * rotation.z + rotation.w * rotation.w);
  const glm::dquat turn(rotation.w / length, rotation.x / length, rotation.y / length, rotation.z / length);
  const glm::dmat3 turned = length > 0 ? glm::mat3_cast(turn) : glm::dmat3(1);
  return Affine(turned[0] * scale.x, turned[1] * scale.y, turned[2] * scale.z, translation);
}

Affine transform_at(const Motion& motion, uint32_t joint, double time) {
  Affine transform = local_transform(motion, motion.joints[joint], time);
  for (uint32_t above = motion.joints[joint].parent; above != MotionJoint::none;
       above = motion.joints[above].parent)
    transform = local_transform(motion, motion.joints[above], time) * glm::dmat4(transform);
  return transform;
}

double longest_clip(const Motion& motion) {
  double longest = 0;
  for (const MotionTrack& track : motion.tracks) longest = std::max(longest, track.length);
  return longest;
}

void check_motion(const Motion& motion, const std::string& place) {
  for (size_t i = 0; i < motion.tracks.size(); ++i)
    check_track(motion.tracks[i], fmt::format("{}: track {}", place, i));
  for (size_t i = 0; i < motion.joints.size(); ++i) {
    const MotionJoint& joint = motion.joints[i];
    const std::string here = fmt::format("{}: joint {}", place, i);
    if (joint.parent != MotionJoint::none && joint.parent >= i) fail(here, "comes before its parent");
    for (const auto& [track, components] :
         {std::pair(joint.translation_track, 3u), std::pair(joint.rotation_track, 4u),
          std::pair(joint.scale_track, 3u)}) {
      if (track == MotionJoint::none) continue;
      if (track >= motion.tracks.size() || motion.tracks[track].components != components)
        fail(here, "follows track {}, which is none for it", track);
    }
    std::vector<double> numbers;
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 3; ++row) numbers.push_back(joint.before[column][row]);
    }
    for (int axis = 0; axis < 3; ++axis) {
      numbers.insert(numbers.end(), {joint.translation[axis], joint.scale[axis], joint.rotation[axis]});
    }
    numbers.push_back(joint.rotation.w);
    if (!all_finite(numbers)) fail(here, "has numbers that are not finite");
  }
}

}  // namespace triptych
