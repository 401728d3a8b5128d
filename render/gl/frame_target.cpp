#include "render/gl/frame_target.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "lod/draw_rank.hpp"
#include "visibility/sample_rectangle.hpp"
#include "visibility/sky_look.hpp"

#include <algorithm>

namespace triptych {

GlFrameTarget::GlFrameTarget(GlPasses& passes, TargetKind kind, int width, int height) : passes_(passes) {
  planes_.emplace(kind, width, height);
}

void GlFrameTarget::begin(const FrameView& view) {
  if (view.view().width != width() || view.view().height != height()) {
    fail("frame target", "a viewport of {}x{} where {}x{} was agreed", view.view().width, view.view().height,
         width(), height());
  }
  view_ = view;
  const FramebufferLayout wanted{.samples = view.state.samples,
                                 .normals = view.state.edges && planes_->has_colors(),
                                 .stencil = !view.section_space.keeps_all()};
  if (!(planes_->layout() == wanted)) {
    const TargetKind own_kind = kind();
    const int own_width = width(), own_height = height();
    planes_.reset();
    picture_.reset();
    planes_.emplace(own_kind, own_width, own_height, wanted);
  }
  planes_->clear();
  sky_use_ = {};
  if (planes_->has_colors() && shows_sky(view.state)) sky_use_ = passes_.sky.draw(view, *planes_);
  transparent_.clear();
  effects_.clear();
  drawn_triangles_ = 0;
  picture_is_made_ = false;
}

void GlFrameTarget::draw(std::span<const DrawableId> drawables) {
  passes_.renderer.set_view(*view_);
  drawn_triangles_ += passes_.renderer.draw(drawables, *planes_, transparent_);
  picture_is_made_ = false;
}

void GlFrameTarget::test(std::span<const ScreenRectangle> rectangles, std::span<const uint32_t> ends,
                         uint32_t min_pixels, std::span<uint8_t> visible) {
  const auto places = sample_places(view_->state.samples);
  if (places.size() == 1) {
    passes_.rectangles.test(*planes_, 0, view_->rules.non_strict_test ? GL_GEQUAL : GL_GREATER, rectangles,
                            ends, min_pixels, visible);
    return;
  }
  std::ranges::fill(visible, uint8_t{0});
  for (uint32_t plane = 0; plane < places.size(); ++plane)
    test_plane(plane, places[plane], rectangles, ends, min_pixels, visible);
}

void GlFrameTarget::test_plane(uint32_t plane, const SamplePlace& place,
                               std::span<const ScreenRectangle> rectangles, std::span<const uint32_t> ends,
                               uint32_t min_pixels, std::span<uint8_t> visible) {
  open_rectangles_.clear();
  open_ends_.clear();
  open_tests_.clear();
  for (uint32_t i = 0; i < ends.size(); ++i) {
    if (visible[i] != 0) continue;
    for (uint32_t k = i == 0 ? 0 : ends[i - 1]; k < ends[i]; ++k)
      open_rectangles_.push_back(at_sample(rectangles[k], place, width(), height()));
    open_ends_.push_back(static_cast<uint32_t>(open_rectangles_.size()));
    open_tests_.push_back(i);
  }
  open_visible_.assign(open_tests_.size(), 0);
  passes_.rectangles.test(*planes_, plane, view_->rules.non_strict_test ? GL_GEQUAL : GL_GREATER,
                          open_rectangles_, open_ends_, min_pixels, open_visible_);
  for (size_t i = 0; i < open_tests_.size(); ++i) visible[open_tests_[i]] = open_visible_[i];
}

/// In draw rank order, each once, over all planes.
void GlFrameTarget::draw_transparent(VisibleSet* owners) const {
  Renderer& renderer = passes_.renderer;
  renderer.set_view(*view_);  // other targets draw, too
  const auto rank = [&](DrawableId id) { return draw_rank(*view_, id); };
  std::ranges::sort(transparent_, {}, rank);
  const auto repeated = std::ranges::unique(transparent_);
  transparent_.erase(repeated.begin(), repeated.end());
  renderer.draw_transparent(transparent_, *planes_, passes_.lists, owners);
}

const Framebuffer& GlFrameTarget::picture() const {
  if (picture_is_made_) return *picture_;
  const bool is_transparent = !transparent_.empty();
  if (!planes_->has_colors() ||
      (planes_->layout().samples == 1 && !planes_->layout().normals && !is_transparent))
    return *planes_;
  if (!picture_) picture_.emplace(TargetKind::color, width(), height());
  const Stopwatch stopwatch;
  if (is_transparent) draw_transparent(nullptr);
  passes_.resolve.draw(*view_, *planes_, is_transparent ? &passes_.lists.veils() : nullptr, *picture_);
  picture_is_made_ = true;
  if (is_transparent) {
    glFinish();
    effects_.push_back(passes_.renderer.effect_use(Effect::transparency));
    effects_.back().ms = stopwatch.milliseconds();
    effects_.back().effect = Effect::transparency;
  }
  return *picture_;
}

VisibleSet GlFrameTarget::transparent_owners() const {
  if (transparent_.empty()) return {};
  VisibleSet owners;
  draw_transparent(&owners);
  std::ranges::sort(owners);
  owners.erase(std::unique(owners.begin(), owners.end()), owners.end());
  return owners;
}

void GlFrameTarget::finish() {
  if (effects_.empty() && planes_->has_colors()) {
    for (const Effect effect : {Effect::vertex_colors, Effect::smooth_normals, Effect::textures,
                                Effect::emission, Effect::baked_light, Effect::ambient}) {
      EffectUse use = passes_.renderer.effect_use(effect);
      use.effect = effect;
      if (use.draws > 0) effects_.push_back(use);
    }
    if (sky_use_.draws > 0) effects_.push_back(sky_use_);
  }
  picture();
  glFinish();
}

}  // namespace triptych
