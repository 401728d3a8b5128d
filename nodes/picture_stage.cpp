#include "nodes/picture_stage.hpp"

#include "base/timeline.hpp"

namespace triptych {

PictureStage::PictureStage(Renderer& renderer, int width, int height, TargetKind kind)
    : renderer_(renderer), target_(kind, width, height), kind_(kind) {}

void PictureStage::begin(const View& view, uint32_t frame) {
  frame_ = frame;
  renderer_.set_view(view);
  target_.clear();
  drawn_triangles_ = drawn_drawables_ = 0;
}

void PictureStage::draw(const std::vector<DrawableId>& drawables) {
  const TimelineScope scope("draw picture", frame_);
  drawn_triangles_ += renderer_.draw(drawables, target_, kind_);
  drawn_drawables_ += drawables.size();
}

void PictureStage::finish() {
  const TimelineScope scope("finish picture", frame_);
  glFinish();
}

}  // namespace triptych
