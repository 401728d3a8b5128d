#include "nodes/picture_stage.hpp"

#include "base/timeline.hpp"

namespace triptych {

PictureStage::PictureStage(Device& device, int width, int height, TargetKind kind)
    : target_(device.make_target(kind, width, height)) {}

void PictureStage::begin(const FrameView& view, uint32_t frame) {
  frame_ = frame;
  target_->begin(view);
}

void PictureStage::draw(std::span<const DrawableId> drawables) {
  const TimelineScope scope("draw picture", frame_);
  target_->draw(drawables);
}

void PictureStage::finish() {
  const TimelineScope scope("finish picture", frame_);
  target_->finish();
}

}  // namespace triptych
