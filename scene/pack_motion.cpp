#include "scene/pack_motion.hpp"

#include "base/record.hpp"

namespace triptych {

template <>
inline constexpr auto record_members<MotionTrack> = std::tuple(&MotionTrack::interpolation,
                                                               &MotionTrack::components, &MotionTrack::length,
                                                               &MotionTrack::times, &MotionTrack::values);
template <>
inline constexpr auto record_members<MotionJoint> =
    std::tuple(&MotionJoint::parent, &MotionJoint::translation_track, &MotionJoint::rotation_track,
               &MotionJoint::scale_track, &MotionJoint::before, &MotionJoint::translation,
               &MotionJoint::rotation, &MotionJoint::scale);
template <>
inline constexpr auto record_members<Motion> = std::tuple(&Motion::tracks, &Motion::joints);
template <>
inline constexpr auto record_members<StoredMotion> = std::tuple(&StoredMotion::motion,
                                                                &StoredMotion::instances);

std::vector<std::byte> encode_motion(const StoredMotion& stored) { return record_bytes(stored); }

StoredMotion decode_motion(std::span<const std::byte> bytes, size_t instances, const std::string& place) {
  ByteReader reader(bytes, place);
  auto stored = read_record<StoredMotion>(reader);
  reader.expect_end();
  check_motion(stored.motion, place);
  size_t least = 0;
  for (const StoredMotion::Instance& moving : stored.instances) {
    if (moving.instance < least || moving.instance >= instances)
      fail(place, "instance {} is not one of those that may follow", moving.instance);
    if (moving.joint >= stored.motion.joints.size())
      fail(place, "instance {} follows joint {} of {}", moving.instance, moving.joint,
           stored.motion.joints.size());
    least = size_t{moving.instance} + 1;
  }
  if (stored.instances.empty()) fail(place, "moves nothing");
  return stored;
}

}  // namespace triptych
