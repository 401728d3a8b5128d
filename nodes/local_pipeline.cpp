#include "nodes/local_pipeline.hpp"

#include "base/clock.hpp"
#include "nodes/pack_strategy.hpp"
#include "visibility/motion_use.hpp"

#include <cassert>
#include <utility>

namespace triptych {

Strategy& LocalPipeline::Parts::strategy(StrategyKind kind) {
  std::unique_ptr<Strategy>& strategy = strategies[kind];
  if (strategy) return *strategy;
  const StrategyChoice choice = choose_strategy(pack, kind, strategy_options);
  strategy = make_strategy(choice.kind, device.hierarchy(), choice.options);
  return *strategy;
}

LocalPipeline::LocalPipeline(const Hierarchy& hierarchy, Device& device, Strategy& strategy,
                             const LocalPipelineOptions& options)
    : options_(options), hierarchy_(hierarchy), device_(device), strategy_(&strategy) {
  resize(options.width, options.height);
}

LocalPipeline::LocalPipeline(const Pack& pack, const LocalPipelineOptions& options)
    : LocalPipeline(std::make_unique<Parts>(pack, options), options) {}

LocalPipeline::LocalPipeline(std::unique_ptr<Parts> parts, const LocalPipelineOptions& options)
    : parts_(std::move(parts)),
      options_(options),
      hierarchy_(parts_->device.hierarchy()),
      device_(parts_->device.device()),
      strategy_(&parts_->strategy(options.cull)) {
  resize(options.width, options.height);
}

Streaming* LocalPipeline::streaming(const FrameState& first) {
  if (!parts_ || parts_->device.read_ahead() == nullptr) return nullptr;
  if (!streaming_) streaming_.emplace(parts_->device, options_.device.memory, first, options_.no_pixel_error);
  return &*streaming_;
}

std::optional<ReadAheadUse> LocalPipeline::read_ahead() const {
  if (!parts_ || parts_->device.read_ahead() == nullptr) return std::nullopt;
  return parts_->device.read_ahead()->use();
}

void LocalPipeline::resize(int width, int height) {
  options_.width = width;
  options_.height = height;
  occlusion_.reset();
  picture_.emplace(device_, width, height, options_.item_buffer ? TargetKind::item : TargetKind::color);
  depth_ = device_.order_matters() ? device_.make_target(TargetKind::depth_only, width, height) : nullptr;
  make_occlusion_stage();
}

void LocalPipeline::make_occlusion_stage() {
  FrameTarget& target = depth_ ? *depth_ : picture_->target();
  occlusion_.emplace(hierarchy_.skeleton(), target, *strategy_, options_.rules);
}

void LocalPipeline::set_strategy(Strategy& strategy) {
  if (&strategy == strategy_) return;
  strategy_ = &strategy;
  make_occlusion_stage();
}

void LocalPipeline::set_strategy(StrategyKind kind) {
  assert(parts_);
  set_strategy(parts_->strategy(kind));
}

const FrameRecord& LocalPipeline::draw(const FrameRequest& frame) {
  if (!streaming(frame.state)) {
    draw_once(frame);
    return record_;
  }
  const Stopwatch whole;
  FrameRequest raised = frame;
  const VisibleSet before = visible_;
  streaming_->begin_frame();
  for (;;) {
    raised.state.pixel_error = streaming_->raise(frame.state.pixel_error);
    try {
      draw_once(raised);
      break;
    } catch (const NoRoom& why) {
      visible_ = before;
      streaming_->refused(raised.state.pixel_error, why);
    }
  }
  streaming_->drawn(occlusion_->view(), visible_, frame.state.pixel_error, record_);
  record_.frame_ms = record_.camera_to_image_ms = whole.milliseconds();
  return record_;
}

void LocalPipeline::draw_once(const FrameRequest& frame) {
  record_.number = frame.number;
  record_.pixel_error = frame.state.pixel_error;
  if (streaming_) streaming_->begin_drawing();
  std::swap(previous_, visible_);
  const Stopwatch whole;
  Stopwatch stage;
  occlusion_->begin(frame);
  const MotionWatch motion(occlusion_->view());
  occlusion_->represent(previous_);
  if (depth_) occlusion_->finish();  // where it is the picture's target, the picture is not finished yet
  record_.occlusion_representation_ms = stage.milliseconds();
  stage.restart();
  NoSink nobody;
  const CullResult& culled = occlusion_->cull(previous_, nobody);
  record_.hardware_cull_ms = stage.milliseconds();
  record_.cut_drawables = culled.selected;
  record_.tests = culled.tests;
  visible_ = culled.visible;

  stage.restart();
  // The view that culling had, unless a fault made it use another camera.
  std::optional<FrameView> own_view;
  if (!(occlusion_->view().state == frame.state))
    own_view.emplace(hierarchy_.skeleton(), frame.state, options_.rules);
  const FrameView& view = own_view ? *own_view : occlusion_->view();
  ordered_ = visible_;
  sorter_.sort(view, ordered_);
  // What is near gets room before what is not: a picture that leaves something out is drawn in draw rank
  // order alone.
  const bool in_order = streaming_ && streaming_->leaves_out();
  const bool begun = !depth_ && !own_view && !in_order && strategy_->representation() != nullptr;
  if (!begun) picture_->begin(view, frame.number);
  picture_->draw(ordered_);
  if (streaming_) streaming_->complete(*picture_, view, visible_, record_);
  picture_->finish();
  record_.render_ms = stage.milliseconds();
  record_.frame_ms = record_.camera_to_image_ms = whole.milliseconds();
  record_.drawn_triangles = picture_->drawn_triangles();
  const auto effects = picture_->target().effects();
  record_.effects.assign(effects.begin(), effects.end());
  motion.add_to(record_.effects);
  difference(previous_, visible_, delta_);
  record_.added = delta_.added.size();
  record_.removed = delta_.removed.size();
  record_.visible_count = visible_.size();
  record_.visible = visible_;
}

}  // namespace triptych
