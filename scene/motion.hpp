// How instances move: tracks of values over time, and the joints that they turn, move and stretch. As of glTF
// 2.0 (section 3.11, Animations).
#pragma once

#include "scene/affine.hpp"

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

namespace triptych {

enum class Interpolation : uint32_t { step, linear, cubic_spline };

/// Values of one property over time. It begins again after its clip's length: what counts is the time modulo
/// that. Before its first key it has the first value, after the last key the last one.
struct MotionTrack {
  Interpolation interpolation = Interpolation::linear;
  uint32_t components = 3;     ///< of a value; 4: quaternions (x, y, z, w)
  double length = 0;           ///< seconds, of its clip; 0: its first value holds for ever
  std::vector<double> times;   ///< seconds, of the keys; they increase
  std::vector<double> values;  ///< of the keys; cubic_spline: in-tangent, value and out-tangent of each
  bool operator==(const MotionTrack&) const = default;
};

/// Something that moves, and may carry others: its space to its parent's is
/// before · translation · rotation · scale.
struct MotionJoint {
  static constexpr uint32_t none = 0xffffffffu;

  uint32_t parent = none;  ///< a joint before this one; none: the space that all is placed in
  /// Indices of tracks; none: the value below holds.
  uint32_t translation_track = none, rotation_track = none, scale_track = none;
  Affine before{1};
  glm::dvec3 translation{0};
  glm::dvec4 rotation{0, 0, 0, 1};  ///< a quaternion (x, y, z, w)
  glm::dvec3 scale{1};
  bool operator==(const MotionJoint&) const = default;
};

struct Motion {
  std::vector<MotionTrack> tracks;
  std::vector<MotionJoint> joints;

  bool empty() const { return joints.empty(); }
  bool operator==(const Motion&) const = default;
};

/// Translation · rotation · scale. Quaternions need not have length 1; one without a length turns nothing.
Affine transform_of_parts(const glm::dvec3& translation, const glm::dvec4& rotation, const glm::dvec3& scale);

/// From the joint's space to that of the topmost one's parent at a time (seconds). The same bits in every
/// process: only additions, multiplications, divisions and square roots, in a fixed order.
Affine transform_at(const Motion& motion, uint32_t joint, double time);

/// A box that holds this one of the joint's space wherever the joint takes it, at any time: from bounds of
/// the tracks between their keys, not from samples of them. box: not empty.
Box swept_box(const Motion& motion, uint32_t joint, const Box& box);

/// The largest factor by which the joint stretches lengths at any time, at most.
double largest_stretch(const Motion& motion, uint32_t joint);

/// The length of the longest clip, seconds; 0 where nothing moves.
double longest_clip(const Motion& motion);

/// Error (place) for tracks and joints that no motion has: counts that do not fit, times that do not
/// increase, numbers that are not finite, references out of range.
void check_motion(const Motion& motion, const std::string& place);

}  // namespace triptych
