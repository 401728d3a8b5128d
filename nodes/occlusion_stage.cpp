#include "nodes/occlusion_stage.hpp"

#include "base/timeline.hpp"

namespace triptych {

OcclusionStage::OcclusionStage(const Skeleton& skeleton, FrameTarget& target, Strategy& strategy,
                               const FrameRules& rules)
    : skeleton_(skeleton), strategy_(strategy), rules_(rules), target_(target) {}

void OcclusionStage::begin(const FrameRequest& frame) {
  const TimelineScope scope("begin occlusion representation", frame.number);
  frame_ = frame.number;
  FrameState state = frame.state;
  if (!rules_.current_camera && last_camera_) state.view = *last_camera_;
  if (!rules_.cut_occludes_nothing) state.section = {};
  if (!rules_.current_time && last_time_) state.time = *last_time_;
  if (!rules_.glass_occludes_nothing) {
    state.effects = Effects::none();
    if (frame.state.effects.has(Effect::motion)) state.effects.add(Effect::motion);
  }
  last_time_ = frame.state.time;
  last_camera_ = frame.state.view;
  view_.emplace(skeleton_, state, rules_);
  if (OcclusionRepresentation* representation = strategy_.representation())
    representation->begin(*view_, target_);
}

void OcclusionStage::represent(const VisibleSet& visible) {
  const TimelineScope scope("draw occlusion representation", frame_);
  if (OcclusionRepresentation* representation = strategy_.representation())
    representation->add(visible, target_);
}

void OcclusionStage::finish() {
  const TimelineScope scope("finish occlusion representation", frame_);
  if (strategy_.representation() != nullptr) target_.finish();
}

const CullResult& OcclusionStage::cull(const VisibleSet& previous, CullSink& sink) {
  const TimelineScope scope("hardware cull", frame_);
  return strategy_.run(*view_, previous, target_, sink);
}

std::span<const DrawableId> OcclusionStage::represented() const {
  OcclusionRepresentation* representation = strategy_.representation();
  return representation != nullptr ? representation->drawables() : std::span<const DrawableId>();
}

uint64_t OcclusionStage::represented_triangles() const {
  uint64_t triangles = 0;
  for (const DrawableId id : represented()) triangles += skeleton_.drawables[id].triangles;
  return triangles;
}

}  // namespace triptych
