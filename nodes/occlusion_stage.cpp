#include "nodes/occlusion_stage.hpp"

#include "base/error.hpp"
#include "base/inject.hpp"
#include "base/timeline.hpp"
#include "visibility/map_to_cut.hpp"

#include <algorithm>

namespace triptych {

OcclusionStage::OcclusionStage(Renderer& renderer, int width, int height, TestKind test)
    : renderer_(renderer),
      skeleton_(renderer.skeleton()),
      tester_(renderer_, width, height, test),
      is_represented_(renderer.skeleton().drawables.size(), false) {}

void OcclusionStage::begin(const FrameRequest& frame) {
  if (frame.view.width != tester_.target().width() || frame.view.height != tester_.target().height()) {
    fail(fmt::format("frame {}", frame.number), "a viewport of {}x{} where {}x{} was agreed",
         frame.view.width, frame.view.height, tester_.target().width(), tester_.target().height());
  }
  const TimelineScope scope("select cut", frame.number);
  frame_ = frame;
  if (injected(Fault::stale_camera) && last_view_) frame_.view = *last_view_;
  last_view_ = frame.view;
  cut_ = select_cut(skeleton_, frame_.view, frame.pixel_error);
  for (const DrawableId id : represented_) is_represented_[id] = false;
  represented_.clear();
  tester_.begin(frame_.view);
}

void OcclusionStage::represent(const VisibleSet& visible) {
  const TimelineScope scope("draw occlusion representation", frame_.number);
  const glm::ivec3 cell = eye_cell(skeleton_, frame_.view);
  std::vector<DrawableId> fresh = map_to_cut(skeleton_, cell, cut_, visible);
  std::erase_if(fresh, [&](DrawableId id) { return is_represented_[id]; });
  for (const DrawableId id : fresh) is_represented_[id] = true;
  represented_.insert(represented_.end(), fresh.begin(), fresh.end());
  tester_.draw(fresh);
}

void OcclusionStage::finish() {
  const TimelineScope scope("finish occlusion representation", frame_.number);
  glFinish();
}

CullResult OcclusionStage::cull(const VisibleSet& previous, const CullOptions& options,
                                const std::function<void(const CullPacket&)>& emit) {
  const TimelineScope scope("hardware cull", frame_.number);
  return hardware_cull(skeleton_, frame_.view, cut_, tester_, represented_, previous, options, emit);
}

uint64_t OcclusionStage::represented_triangles() const {
  uint64_t triangles = 0;
  for (const DrawableId id : represented_) triangles += skeleton_.drawables[id].triangles;
  return triangles;
}

}  // namespace triptych
