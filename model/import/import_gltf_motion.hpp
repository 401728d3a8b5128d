// What the animations of a glTF file move: nodes, with all that is below them.
#pragma once

#include "model/import/import_gltf.hpp"
#include "scene/motion.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace triptych {

/// All animations of the file play at once, each over and over; where several move the same property of a
/// node, the first one does. Those of weights are counted in a warning, and not played.
class GltfMotion {
 public:
  static constexpr uint32_t rests = MotionJoint::none;

  /// Error (file, animation, channel) for references out of range, a path or an interpolation that is not
  /// known, times that do not increase, as many values as the keys do not have, and numbers that are not
  /// finite.
  GltfMotion(const GltfFile& gltf, FileImport& target);

  /// Whether a node turns, moves or stretches by itself.
  bool moves(size_t node) const { return !tracks_.empty() && tracks_[node].any(); }
  /// Whether it does, or one that it is below.
  bool is_carried(size_t node) const { return !carried_.empty() && carried_[node]; }

  /// The joint of a node that moves(). above: of what carries it, or `rests`; before: its parent's space to
  /// that one's.
  uint32_t add_joint(size_t node, uint32_t above, const Affine& before);
  /// What a joint carries, in its space; objects count from those of the file's first.
  Group& carried_by(uint32_t joint) { return groups_[joint]; }
  /// Once all is placed.
  void place_groups();

 private:
  struct NodeTracks {
    uint32_t translation = MotionJoint::none, rotation = MotionJoint::none, scale = MotionJoint::none;
    bool any() const {
      return translation != MotionJoint::none || rotation != MotionJoint::none || scale != MotionJoint::none;
    }
  };
  void read_animation(size_t animation);
  void read_channel(const GltfAnimation& animation, const GltfAnimationChannel& channel, double length,
                    const std::string& place);
  MotionTrack read_track(const GltfAnimation& animation, const GltfAnimationChannel& channel,
                         uint32_t components, const std::string& place) const;
  void find_carried();

  const GltfFile& gltf_;
  FileImport& target_;
  Motion motion_;
  std::vector<NodeTracks> tracks_;  ///< of each node; empty where nothing moves
  std::vector<bool> carried_;       ///< the same
  std::vector<Group> groups_;       ///< of each joint
};

}  // namespace triptych
