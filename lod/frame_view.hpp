// Everything that one frame's camera implies: computed once a frame, and passed on.
#pragma once

#include "base/rounding.hpp"
#include "lod/clip_space.hpp"
#include "lod/eye_space.hpp"
#include "lod/frame_rules.hpp"
#include "lod/section_space.hpp"
#include "scene/frame_state.hpp"
#include "scene/hidden_objects.hpp"
#include "scene/poses.hpp"
#include "scene/skeleton.hpp"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>

namespace triptych {

/// One frame's view of one skeleton, which must outlive it. A plain value: copying it allocates nothing.
/// Error (place: frame) where the state names hidden objects without having them.
struct FrameView {
  FrameView(const Skeleton& skeleton, const FrameState& state, const FrameRules& rules = {});

  const View& view() const { return state.view; }
  /// How much of a scene node is hidden.
  HiddenShare hidden(SceneNodeId node) const {
    return state.hiding.objects ? state.hiding.objects->share(node) : HiddenShare::nothing;
  }
  /// Of a scene node in this frame, on the model's lattice: what moves is not where it always may be.
  LatticeBox box(SceneNodeId node) const {
    const LatticeBox& always = skeleton->scene_nodes[node].box;
    return moves(node) ? poses->box(skeleton->lattice(), node, always) : always;
  }
  bool moves(SceneNodeId node) const { return poses && poses->moves(node); }
  /// The placement's transform in this frame. transform: index into Skeleton::transforms.
  Affine transform(uint32_t transform) const {
    const Affine& always = skeleton->transforms[transform];
    return poses ? poses->transform(transform, always) : always;
  }
  /// As ClosedSurfaces::reach(), in this frame.
  LatticeBox reach(SceneNodeId node) const;
  /// Where a box lies in the frame's section.
  SectionPlace section_place(const LatticeBox& box) const;
  /// The same of the box around several: what is solid may reach from one into another.
  SectionPlace section_place(std::span<const LatticeBox> boxes) const;

  const Skeleton* skeleton;
  FrameState state;
  FrameRules rules;
  glm::dmat3 rotation;      ///< model to eye axes; View::rotation()
  glm::ivec3 cell;          ///< of the eye on the model lattice, for draw ranks
  double focal_length = 1;  ///< pixels; what the pixel error is measured with
  ClipSpace clip;           ///< eye space to clip space
  EyeSpace eye_space;       ///< where boxes lie, for selection
  SectionSpace section_space;
  std::shared_ptr<const Poses> poses;  ///< of what moves; null where nothing does

 private:
  FrameView(const NearestRounding&, const Skeleton& skeleton, const FrameState& state,
            const FrameRules& rules);
};

}  // namespace triptych
