#include "raster/raster_target.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/threads.hpp"
#include "raster/box_test.hpp"
#include "raster/float_state.hpp"
#include "raster/lines.hpp"
#include "raster/resolve.hpp"
#include "visibility/sample_rectangle.hpp"
#include "visibility/shading.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace triptych {

RasterTarget::RasterTarget(RasterScene& scene, TargetKind kind, int width, int height,
                           const RasterOptions& options)
    : scene_(scene), kind_(kind), options_(options), drawn_(scene.skeleton().drawables.size()) {
  make_planes(1, width, height);
}

void RasterTarget::make_planes(size_t count, int width, int height) {
  while (planes_.size() > count) planes_.pop_back();
  while (planes_.size() < count)
    planes_.emplace_back(width, height, kind_ == TargetKind::depth_only, options_.max_slots);
}

DeviceMargins RasterTarget::margins() const { return steady_margins; }

void RasterTarget::begin(const FrameView& view) {
  if (view.view().width != width() || view.view().height != height()) {
    fail("frame target", "a viewport of {}x{} where {}x{} was agreed", view.view().width, view.view().height,
         width(), height());
  }
  const FloatState state;
  view_ = view;
  scene_.set_view(view);
  make_planes(view.state.samples, width(), height());
  for (VisibilityBuffer& plane : planes_) plane.clear();
  drawn_.clear();
  transparent_.clear();
  drawn_triangles_ = 0;
  picture_is_made_ = false;
  effects_.clear();
}

void RasterTarget::draw(std::span<const DrawableId> drawables) {
  const FloatState state;
  fresh_.clear();
  for (const DrawableId id : drawables) {
    if (drawn_.mark_first(id)) fresh_.push_back(id);
  }
  if (fresh_.empty()) return;
  scene_.set_view(*view_);  // other targets draw, too
  drawn_triangles_ += scene_.draw(fresh_, planes_, transparent_);
  picture_is_made_ = false;
}

void RasterTarget::test(std::span<const ScreenRectangle> rectangles, std::span<const uint32_t> ends,
                        uint32_t min_pixels, std::span<uint8_t> visible) {
  const bool strict = !view_->rules.non_strict_test;
  const auto places = sample_places(view_->state.samples);
  const auto count = [&](size_t plane, const ScreenRectangle& rectangle, uint32_t enough) {
    return planes_.size() == 1
               ? count_pixels(planes_[plane], rectangle, strict, enough)
               : count_pixels(planes_[plane], at_sample(rectangle, places[plane], width(), height()), strict,
                              enough);
  };
  const auto test_some = [&](size_t begin, size_t end) {
    const FloatState state;
    for (size_t i = begin; i < end; ++i) {
      const size_t first = i == 0 ? 0 : ends[i - 1];
      const auto own = rectangles.subspan(first, ends[i] - first);
      visible[i] = 0;
      for (size_t plane = 0; plane < planes_.size() && visible[i] == 0; ++plane) {
        uint32_t missing = min_pixels;
        for (auto next = own.begin(); next != own.end() && missing > 0; ++next)
          missing -= count(plane, *next, missing);
        visible[i] = missing == 0;
      }
    }
  };
  // Few tests take less time than waking other threads.
  constexpr size_t worth_sharing = 128, share = 32;
  if (ends.size() >= worth_sharing) {
    parallel_for((ends.size() + share - 1) / share,
                 [&](size_t i) { test_some(i * share, std::min((i + 1) * share, ends.size())); });
  } else {
    test_some(0, ends.size());
  }
}

bool RasterTarget::hides(const ScreenExtent& extent) const {
  const bool strict = !view_->rules.non_strict_test;
  const auto places = sample_places(view_->state.samples);
  for (size_t i = 0; i < planes_.size(); ++i) {
    const ScreenExtent seen = planes_.size() == 1 ? extent : at_sample(extent, places[i], width(), height());
    if (!triptych::hides(planes_[i], seen, strict)) return false;
  }
  return true;
}

void RasterTarget::finish() {
  if (has_colors()) make_picture();
}

void RasterTarget::make_picture() const {
  if (picture_is_made_) return;
  const FloatState state;
  picture_.resize(static_cast<size_t>(width()) * static_cast<size_t>(height()));
  if (!view_) {
    std::fill(picture_.begin(), picture_.end(), background_bytes);
  } else {
    const Stopwatch stopwatch;
    const std::vector<TransparentLayers> layers = transparent_layers();
    const double set_up = stopwatch.milliseconds();
    do {
      ShadingCounts counts;
      if (planes_.size() == 1 && !view_->state.edges) {
        shade(planes_.front(), *view_, scene_.textures(), layers, picture_, counts);
      } else {
        resolve(planes_, *view_, scene_.textures(), layers, picture_, counts);
      }
      count_effects(counts, set_up);
    } while (!scene_.fit_textures());
  }
  picture_is_made_ = true;
}

void RasterTarget::count_effects(const ShadingCounts& counts, double set_up_ms) const {
  effects_.clear();
  const auto ms_of = [&](ShadeKind kind) -> double { return counts.varying_ms[static_cast<size_t>(kind)]; };
  const auto add = [&](Effect effect, double ms, uint64_t pixels) {
    effects_.push_back({.effect = effect, .ms = ms, .fragments = pixels});
  };
  const uint64_t textured_pixels = counts.varying_pixels[static_cast<size_t>(ShadeKind::textured)];
  if (counts.colored_pixels > 0) add(Effect::vertex_colors, ms_of(ShadeKind::colored), counts.colored_pixels);
  if (counts.smooth_triangles > 0) {
    uint64_t pixels = 0;
    double ms = 0;  // the share of each kind's time, by pixels
    for (size_t kind = 0; kind < counts.smooth_pixels.size(); ++kind) {
      const uint64_t smooth = counts.smooth_pixels[kind], all = counts.varying_pixels[kind];
      pixels += smooth;
      if (smooth > 0)
        ms += counts.varying_ms[kind] * (static_cast<double>(smooth) / static_cast<double>(all));
    }
    add(Effect::smooth_normals, ms, pixels);
  }
  if (textured_pixels > 0) add(Effect::textures, ms_of(ShadeKind::textured), textured_pixels);
  if (counts.baked_pixels > 0) add(Effect::baked_light, ms_of(ShadeKind::lit), counts.baked_pixels);
  if (counts.occluded_pixels > 0) add(Effect::ambient, ms_of(ShadeKind::lit), counts.occluded_pixels);
  if (counts.emissive_pixels > 0) add(Effect::emission, ms_of(ShadeKind::emissive), counts.emissive_pixels);
  if (counts.sky_pixels > 0) add(Effect::sky, counts.sky_ms, counts.sky_pixels);
  if (!transparent_.empty()) {
    effects_.push_back({.effect = Effect::transparency,
                        .ms = set_up_ms + counts.blending_ms,
                        .draws = transparent_.size(),
                        .fragments = counts.blended_fragments,
                        .splits = counts.splits});
  }
}

std::vector<TransparentLayers> RasterTarget::transparent_layers() const {
  if (transparent_.empty()) return {};
  scene_.set_view(*view_);  // other targets draw, too
  return scene_.transparent_layers(transparent_, planes_, options_.max_fragments);
}

VisibleSet RasterTarget::transparent_owners() const {
  VisibleSet drawables;
  for (const TransparentLayers& layers : transparent_layers()) add_owners(layers, drawables);
  std::sort(drawables.begin(), drawables.end());
  drawables.erase(std::unique(drawables.begin(), drawables.end()), drawables.end());
  return drawables;
}

void RasterTarget::draw_lines(std::span<const ScreenLine> lines) {
  make_picture();
  triptych::draw_lines(lines, width(), height(), picture_);
}

std::span<const uint8_t> RasterTarget::colors_in_memory() const {
  assert(has_colors());
  make_picture();
  return {reinterpret_cast<const uint8_t*>(picture_.data()), picture_.size() * sizeof(Rgba)};
}

std::vector<uint8_t> RasterTarget::read_colors() const {
  const std::span<const uint8_t> colors = colors_in_memory();
  return {colors.begin(), colors.end()};
}

std::vector<uint32_t> RasterTarget::read_items(uint32_t sample) const {
  assert(kind_ == TargetKind::item || kind_ == TargetKind::color_and_item);
  std::vector<uint32_t> items(static_cast<size_t>(width()) * static_cast<size_t>(height()));
  name_items(planes_[sample], items);
  return items;
}

}  // namespace triptych
