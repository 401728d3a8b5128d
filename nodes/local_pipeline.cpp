#include "nodes/local_pipeline.hpp"

#include "base/clock.hpp"

#include <cassert>
#include <utility>

namespace triptych {

Strategy& LocalPipeline::Parts::strategy(StrategyKind kind) {
  std::unique_ptr<Strategy>& strategy = strategies[kind];
  if (!strategy) strategy = make_strategy(kind, device.hierarchy(), strategy_options);
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

void LocalPipeline::begin_streaming(const FrameState& first) {
  const MemoryCaps& caps = options_.device.memory;
  // Depth, ids, and colours, for each sample, and a copy of the picture.
  const uint64_t pixels = static_cast<uint64_t>(options_.width) * static_cast<uint64_t>(options_.height);
  constexpr uint64_t a_sample = 16, a_pixel = 8;
  const uint64_t ahead = PackDevice::read_ahead_bytes(caps);
  keeper_.emplace(device_, caps, ahead, (a_sample * first.samples + a_pixel) * pixels);
  prefetch_.emplace(hierarchy_, device_, *parts_->device.read_ahead(), ahead / 4);
  if (caps.on_miss == OnMiss::coarser)
    substitutes_.emplace(hierarchy_, device_, *parts_->device.read_ahead());
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
  if (!parts_ || !options_.device.memory.streams()) {
    draw_once(frame);
    return record_;
  }
  if (!keeper_) begin_streaming(frame.state);
  const Stopwatch whole;
  FrameRequest raised = frame;
  const VisibleSet before = visible_;
  const uint64_t no_room = device_.geometry_use().no_room;
  parts_->device.read_ahead()->next_frame();
  for (;;) {
    raised.state.pixel_error = keeper_->raise(frame.state.pixel_error);
    try {
      draw_once(raised);
      break;
    } catch (const NoRoom& why) {
      visible_ = before;
      keeper_->refused(raised.state.pixel_error, why);
    }
  }
  record_.raised_for_memory = raised.state.pixel_error > frame.state.pixel_error;
  // Whoever draws between frames, as a view from outside, does without what has no room.
  device_.set_missing({.wait = true, .refuse = false, .fail = !substitutes_});
  keeper_->drawn();
  if (device_.geometry_use().no_room > no_room) keeper_->crowded(raised.state.pixel_error);
  prefetch_->drawn(occlusion_->view(), visible_);
  record_.loading = record_.owed_drawables > 0 && read_ahead()->open > 0;
  record_.frame_ms = record_.camera_to_image_ms = whole.milliseconds();
  return record_;
}

void LocalPipeline::draw_once(const FrameRequest& frame) {
  record_.number = frame.number;
  record_.pixel_error = frame.state.pixel_error;
  record_.owed_drawables = 0;
  const uint64_t left_out = device_.geometry_use().left_out;
  if (keeper_) device_.set_missing({.wait = !substitutes_, .refuse = !substitutes_, .fail = !substitutes_});
  std::swap(previous_, visible_);
  const Stopwatch whole;
  Stopwatch stage;
  occlusion_->begin(frame);
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
  sorter_.sort(hierarchy_.skeleton(), view.cell, ordered_);
  const bool begun = !depth_ && !own_view && strategy_->representation() != nullptr;
  if (!begun) picture_->begin(view, frame.number);
  picture_->draw(ordered_);
  if (substitutes_ && device_.geometry_use().left_out > left_out) draw_substitutes(view);
  picture_->finish();
  record_.render_ms = stage.milliseconds();
  record_.frame_ms = record_.camera_to_image_ms = whole.milliseconds();
  record_.drawn_triangles = picture_->drawn_triangles();
  const auto effects = picture_->target().effects();
  record_.effects.assign(effects.begin(), effects.end());
  difference(previous_, visible_, delta_);
  record_.added = delta_.added.size();
  record_.removed = delta_.removed.size();
  record_.visible_count = visible_.size();
  record_.visible = visible_;
}

void LocalPipeline::draw_substitutes(const FrameView& view) {
  VisibleSet shown = visible_;
  record_.owed_drawables = substitutes_->replace(view, shown);
  sorter_.sort(hierarchy_.skeleton(), view.cell, shown);
  device_.set_missing({.wait = true, .refuse = true, .fail = false});
  picture_->begin(view, record_.number);
  picture_->draw(shown);
}

}  // namespace triptych
