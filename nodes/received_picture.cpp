#include "nodes/received_picture.hpp"

namespace triptych {

ReceivedPicture::ReceivedPicture(PictureStage& picture, Streaming* streaming, const SessionRules& rules)
    : picture_(picture), streaming_(streaming), rules_(rules) {
  if (!streaming_) return;
  streaming_->begin_frame();
  streaming_->begin_drawing();
}

template <typename Draw>
void ReceivedPicture::in_room(const Draw& draw) {
  if (no_room_) return;
  const StageWatch watch;
  rules_.slow_down();
  try {
    draw();
  } catch (const NoRoom& why) {
    no_room_ = why;
  }
  const SpentTime spent = watch.spent();
  spent_.wall_ms += spent.wall_ms;
  spent_.cpu_ms += spent.cpu_ms;
}

void ReceivedPicture::begin(const FrameView& view, uint32_t frame) {
  if (!motion_) motion_.emplace(view);
  picture_.begin(view, frame);
}

void ReceivedPicture::draw(std::span<const DrawableId> drawables) {
  in_room([&] { picture_.draw(drawables); });
}

void ReceivedPicture::finish(const FrameView& view, const VisibleSet& visible, FrameRecord& record) {
  in_room([&] {
    if (streaming_) streaming_->complete(picture_, view, visible, record);
    picture_.finish();
  });
  const auto effects = picture_.target().effects();
  record.effects.assign(effects.begin(), effects.end());
  if (motion_) motion_->add_to(record.effects);
}

}  // namespace triptych
