#include "lod/frame_view.hpp"

#include "base/error.hpp"
#include "lod/draw_rank.hpp"

namespace triptych {

FrameView::FrameView(const Skeleton& of_skeleton, const FrameState& of_state, const FrameRules& with_rules)
    : FrameView(NearestRounding(), of_skeleton, of_state, with_rules) {}

[[gnu::noinline]] FrameView::FrameView(const NearestRounding&, const Skeleton& of_skeleton,
                                       const FrameState& of_state, const FrameRules& with_rules)
    : skeleton(&of_skeleton),
      state(of_state),
      rules(with_rules),
      rotation(of_state.view.rotation()),
      cell(eye_cell(of_skeleton, of_state.view)),
      focal_length(of_state.view.focal_length()),
      clip(clip_space(of_skeleton, of_state.view, rotation, with_rules.model_units)),
      eye_space(of_skeleton, of_state.view, rotation, with_rules),
      section_space(of_state, clip, focal_length),
      poses(poses_of(of_skeleton, of_state)) {
  if (state.hiding.name.count > 0 && !state.hiding.objects)
    fail("frame", "{} objects are hidden, and nobody said which", state.hiding.name.count);
}

LatticeBox FrameView::reach(SceneNodeId node) const {
  const SceneNode& of = skeleton->scene_nodes[node];
  if (!moves(node)) return skeleton->closed.reach(node, of);
  // Divided bodies are of one mesh, and so in one instance.
  return skeleton->closed.bodies.empty() ? box(node) : poses->instance_box(skeleton->lattice(), node, of.box);
}

SectionPlace FrameView::section_place(const LatticeBox& box) const { return section_place({&box, 1}); }

[[gnu::noinline]] SectionPlace FrameView::section_place(std::span<const LatticeBox> boxes) const {
  if (section_space.keeps_all()) return {};
  const NearestRounding rounding;
  LatticeBox around;
  for (const LatticeBox& box : boxes) around.extend(box);
  const Box box = skeleton->lattice().box(around);
  return section_space.place(box, eye_space.rounding(box));
}

}  // namespace triptych
