#include "measure/accuracy/accuracy_ground.hpp"

#include "base/spent_time.hpp"
#include "measure/accuracy/motion.hpp"
#include "measure/frame_timing.hpp"
#include "render/png_file.hpp"

#include <algorithm>
#include <fmt/core.h>

namespace triptych {

AccuracyGround::AccuracyGround(const AccuracySubject& subject, const SpeedDevice& device,
                               const PackSurfaces& surfaces, std::span<const FrameRequest> frames,
                               const AccuracyOptions& options, const std::optional<Butteraugli>& perceptual,
                               AccuracyResult& result)
    : device_(device),
      surfaces_(surfaces),
      skeleton_(subject.pack.skeleton()),
      hiding_(subject.hiding),
      frames_(frames),
      options_(options),
      perceptual_(perceptual),
      result_(result),
      first_(result.rows.empty()),
      samples_(frames.front().state.samples),
      picture_(device.device, frames.front().state.view.width, frames.front().state.view.height,
               TargetKind::color_and_item) {
  const View& view = frames.front().state.view;
  if (samples_ > 1) centers_.emplace(device.device, view.width, view.height, TargetKind::item);
  const size_t pixels = static_cast<size_t>(view.width) * static_cast<size_t>(view.height);
  points_ = spread_pixels(options.points == 0 ? pixels : options.points, pixels);
  for (const double pixel_error : options.pixel_errors)
    whole_cuts_.push_back({pixel_error, std::make_shared<PictureTally>()});
  const PackOptions build = subject.pack.read_options();
  for (const AccuracyStrategy& strategy : options.strategies) {
    for (size_t cut = 0; cut < whole_cuts_.size(); ++cut) {
      Setting setting{.row = result.rows.size(),
                      .whole_cut = cut,
                      .strategy = strategy.make(subject.pack, device.hierarchy)};
      const auto* approximate = dynamic_cast<const ApproximateStrategy*>(setting.strategy.get());
      setting.exact = approximate == nullptr;
      setting.pipeline = std::make_unique<LocalPipeline>(
          device.hierarchy, device.device, *setting.strategy,
          LocalPipelineOptions{.width = view.width, .height = view.height, .rules = rules_});
      result.rows.push_back(
          {.pack = subject.name,
           .strategy = strategy.name,
           .representation = subject.representation,
           .device = device.name,
           .build = build,
           .build_seconds = subject.build_seconds,
           .pack_bytes = subject.pack.size(),
           .may_miss = approximate ? approximate->may_miss() : "",
           .min_pixels = strategy.min_pixels,
           .width = view.width,
           .height = view.height,
           .samples = samples_,
           .pixel_error = whole_cuts_[cut].pixel_error,
           .pictures = setting.exact ? whole_cuts_[cut].tally : std::make_shared<PictureTally>()});
      settings_.push_back(std::move(setting));
    }
  }
}

FrameState AccuracyGround::state_of(size_t frame, double pixel_error) const {
  FrameState state = frames_[frame].state;
  state.pixel_error = pixel_error;
  state.hiding = hiding_;
  return state;
}

FrameView AccuracyGround::view_of(size_t frame, double pixel_error) const {
  return FrameView(skeleton_, state_of(frame, pixel_error), rules_);
}

std::vector<uint32_t> AccuracyGround::draw_items(const FrameView& view, std::span<const DrawableId> ordered) {
  PictureStage& stage = centers_ ? *centers_ : picture_;
  FrameState state = view.state;
  state.samples = 1;
  stage.begin(FrameView(skeleton_, state, rules_));
  stage.draw(ordered);
  stage.finish();
  return stage.target().read_items();
}

/// The surfaces are not looked at yet.
ShownPicture AccuracyGround::draw_picture(const FrameView& view, std::span<const DrawableId> ordered) {
  picture_.begin(view);
  picture_.draw(ordered);
  picture_.finish();
  return {picture_.target().read_colors(),
          centers_ ? draw_items(view, ordered) : picture_.target().read_items(),
          {}};
}

void AccuracyGround::begin(size_t frame, const FramePlan& plan) {
  if (frame > 0 && frames_[frame].number != frames_[frame - 1].number + 1) forget_motion();
  if (plan.keep || plan.compare) {
    const FrameView full = view_of(frame, 0);
    reference_ = draw_picture(full, lister_.list(full));
    recent_reference_.push(reference_.colors);
    if (plan.compare) {
      reference_.surface = surface_pixels(surfaces_, full, reference_.items);
      finer_.emplace(full, [this](const FrameView& view) { return draw_items(view, lister_.list(view)); });
    }
  } else {
    recent_reference_.clear();
  }
  for (WholeCut& whole : whole_cuts_) {
    const FrameView view = view_of(frame, whole.pixel_error);
    whole.picture = draw_picture(view, lister_.list(view));  // loads what the settings draw
    if (plan.compare) whole.owners = owners(picture_.target(), samples_);
    if (plan.keep || plan.compare) {
      whole.recent.push(whole.picture.colors);
    } else {
      whole.recent.clear();
    }
    if (plan.compare) compare_whole_cut(whole, frame, plan);
  }
  if (!plan.compare) return;
  if (options_.shifts > 0) measure_covers(frame);
  for (WholeCut& whole : whole_cuts_)
    whole.tally->add(whole.measures, reference_.colors, whole.picture.colors);
  if (!first_ || !plan.exhibit) return;
  const auto exhibit = [&](double pixel_error, const ShownPicture& picture) {
    const View& view = frames_[frame].state.view;
    result_.pictures.push_back({pixel_error, frames_[frame].number, view.width, view.height, picture.colors});
  };
  exhibit(0, reference_);
  for (const WholeCut& whole : whole_cuts_) exhibit(whole.pixel_error, whole.picture);
}

void AccuracyGround::compare_whole_cut(WholeCut& whole, size_t frame, const FramePlan& plan) {
  const FrameView view = view_of(frame, whole.pixel_error);
  whole.cut = select_cut(view);
  whole.picture.surface = surface_pixels(surfaces_, view, whole.picture.items);
  whole.measures = measure_picture(surfaces_, view, frames_[frame].number, reference_, whole.picture,
                                   {whole.cut, points_, *finer_});
  add_motion(whole.measures, whole.recent);
  if (plan.perceptual && perceptual_) whole.measures.butteraugli = perceptual_distance(whole.picture);
}

void AccuracyGround::forget_motion() {
  recent_reference_.clear();
  for (WholeCut& whole : whole_cuts_) whole.recent.clear();
  for (Setting& setting : settings_) setting.recent.clear();
}

void AccuracyGround::add_motion(PictureMeasures& measures, const RecentColors& recent) const {
  if (recent.last.empty() || recent_reference_.last.empty()) return;
  measures.popping = popping(recent_reference_.last, recent_reference_.current, recent.last, recent.current,
                             measures.width, measures.height);
  if (!recent.before_last.empty())
    measures.flickering_pixels = flickering_pixels(recent.before_last, recent.last, recent.current);
}

void AccuracyGround::add_cover(const FrameView& shifted, std::span<const DrawableId> ordered,
                               CoverCounts& counts) {
  count_cover(surfaces_, shifted, draw_items(shifted, ordered), small_leaves_, counts);
}

void AccuracyGround::measure_covers(size_t frame) {
  reference_cover_.clear();
  small_leaves_ = small_leaves(skeleton_, view_of(frame, 0), reference_.items);
  std::vector<CoverCounts> shown(whole_cuts_.size());
  for (const glm::dvec2& shift : pixel_shifts(small_leaves_.empty() ? 0 : options_.shifts)) {
    const auto moved = [&](double pixel_error) {
      return FrameView(skeleton_, shifted(view_of(frame, pixel_error).state, shift), rules_);
    };
    const FrameView full = moved(0);
    count_cover(skeleton_, draw_items(full, lister_.list(full)), small_leaves_, reference_cover_);
    for (size_t cut = 0; cut < whole_cuts_.size(); ++cut) {
      const FrameView view = moved(whole_cuts_[cut].pixel_error);
      add_cover(view, lister_.list(view), shown[cut]);
    }
  }
  for (size_t cut = 0; cut < whole_cuts_.size(); ++cut)
    whole_cuts_[cut].measures.cover = compare_cover(reference_cover_, shown[cut]);
}

double AccuracyGround::perceptual_distance(const ShownPicture& shown) const {
  const View& view = frames_.front().state.view;
  const std::filesystem::path reference = options_.scratch / "reference.png",
                              other = options_.scratch / "shown.png";
  write_png(reference, view.width, view.height, reference_.colors);
  write_png(other, view.width, view.height, shown.colors);
  return perceptual_->distance(reference, other);
}

void AccuracyGround::draw(size_t which, size_t frame, const FramePlan& plan) {
  Setting& setting = settings_[which];
  const FrameRequest request{frames_[frame].number,
                             state_of(frame, whole_cuts_[setting.whole_cut].pixel_error)};
  begin_other_view(setting.pipeline->target(), skeleton_, request);
  const double cpu_before = process_cpu_milliseconds();
  const FrameRecord& record = setting.pipeline->draw(request);
  result_.rows[setting.row].frames.push_back(
      {.frame_ms = record.frame_ms,
       .cpu_ms = process_cpu_milliseconds() - cpu_before,
       .occlusion_representation_ms = record.occlusion_representation_ms,
       .hardware_cull_ms = record.hardware_cull_ms,
       .render_ms = record.render_ms,
       .drawn_triangles = record.drawn_triangles,
       .drawables = record.visible_count});
  if (plan.compare || plan.keep) compare_setting(setting, frame, plan, record);
}

VisibleSet AccuracyGround::drawn_of(const Setting& setting, const FrameRecord& record) const {
  VisibleSet drawn = record.visible;
  const OcclusionRepresentation* representation = setting.strategy->representation();
  if (device_.device.order_matters() || representation == nullptr) return drawn;
  const std::span<const DrawableId> represented = representation->drawables();
  drawn.insert(drawn.end(), represented.begin(), represented.end());
  std::sort(drawn.begin(), drawn.end());
  drawn.erase(std::unique(drawn.begin(), drawn.end()), drawn.end());
  return drawn;
}

void AccuracyGround::compare_setting(Setting& setting, size_t frame, const FramePlan& plan,
                                     const FrameRecord& record) {
  WholeCut& whole = whole_cuts_[setting.whole_cut];
  AccuracyRow& row = result_.rows[setting.row];
  std::vector<uint8_t> colors = setting.pipeline->target().read_colors();
  const bool equal = colors == whole.picture.colors;
  if (!setting.exact) setting.recent.push(colors);
  if (!plan.compare) return;
  const VisibleSet drawn = drawn_of(setting, record);
  for (const DrawableId id : whole.owners) {
    const uint32_t triangles = skeleton_.drawables[id].triangles;
    row.owning_triangles += triangles;
    if (!std::binary_search(drawn.begin(), drawn.end(), id)) row.missed_triangles += triangles;
  }
  if (setting.exact) {
    if (!equal)
      result_.violations.push_back(
          {setting.row, "the culled picture is not that of the whole cut", frames_[frame].number});
    return;
  }
  PictureMeasures measures = whole.measures;
  if (!equal) {
    const FrameView view = view_of(frame, whole.pixel_error);
    std::vector<DrawableId> ordered = drawn;
    sort_by_rank(view, ordered);
    ShownPicture shown{std::move(colors), draw_items(view, ordered), {}};
    shown.surface = surface_pixels(surfaces_, view, shown.items);
    measures = measure_picture(surfaces_, view, frames_[frame].number, reference_, shown,
                               {whole.cut, points_, *finer_});
    if (plan.perceptual && perceptual_) measures.butteraugli = perceptual_distance(shown);
    if (whole.measures.cover) {
      CoverCounts counts;
      for (const glm::dvec2& shift : pixel_shifts(small_leaves_.empty() ? 0 : options_.shifts))
        add_cover(FrameView(skeleton_, shifted(view.state, shift), rules_), ordered, counts);
      measures.cover = compare_cover(reference_cover_, counts);
    }
  }
  add_motion(measures, setting.recent);
  row.pictures->add(measures, reference_.colors, setting.recent.current);
}

}  // namespace triptych
