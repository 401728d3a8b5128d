#include "nodes/fallback.hpp"

#include "base/clock.hpp"

#include <algorithm>

namespace triptych {

Fallback::Fallback(const Pack& pack, const FallbackOptions& options)
    : options_(options),
      renderer_(pack),
      occlusion_(renderer_, options.width, options.height, options.test),
      picture_(renderer_, options.width, options.height,
               options.item_buffer ? TargetKind::item : TargetKind::color) {}

FrameRecord Fallback::draw(const FrameRequest& frame) {
  FrameRecord record{.number = frame.number};
  const VisibleSet previous = std::move(visible_);
  const Stopwatch whole;
  std::vector<DrawableId> ordered;
  if (options_.cull == CullMode::occlusion) {
    Stopwatch stage;
    occlusion_.begin(frame);
    occlusion_.represent(previous);
    occlusion_.finish();
    record.occlusion_representation_ms = stage.milliseconds();
    stage.restart();
    const CullResult culled = occlusion_.cull(previous, options_.batches, [](const CullPacket&) {});
    record.hardware_cull_ms = stage.milliseconds();
    record.cut_drawables = occlusion_.cut().drawables.size();
    record.tests = culled.tests;
    visible_ = culled.visible;
    ordered = visible_;
    sort_by_rank(renderer_.skeleton(), eye_cell(renderer_.skeleton(), frame.view), ordered);
  } else {
    ordered = select_cut(renderer_.skeleton(), frame.view, frame.pixel_error,
                         options_.cull == CullMode::frustum ? FrustumCulling::on : FrustumCulling::off)
                  .drawables;
    record.cut_drawables = ordered.size();
    visible_ = ordered;
    std::sort(visible_.begin(), visible_.end());
  }
  const Stopwatch stage;
  picture_.begin(frame.view);
  picture_.draw(ordered);
  picture_.finish();
  record.render_ms = stage.milliseconds();
  record.frame_ms = record.camera_to_image_ms = whole.milliseconds();
  record.drawn_triangles = picture_.drawn_triangles();
  const VisibleDelta delta = difference(previous, visible_);
  record.added = delta.added.size();
  record.removed = delta.removed.size();
  record.visible_count = visible_.size();
  record.visible = visible_;
  return record;
}

}  // namespace triptych
