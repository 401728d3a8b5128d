#include "render/gl/frame_target.hpp"

#include "base/error.hpp"
#include "visibility/sample_rectangle.hpp"

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
    if (planes_->has_colors() && (wanted.samples > 1 || wanted.normals))
      picture_.emplace(TargetKind::color, own_width, own_height);
  }
  planes_->clear();
  drawn_triangles_ = 0;
  picture_is_made_ = false;
}

void GlFrameTarget::draw(std::span<const DrawableId> drawables) {
  passes_.renderer.set_view(*view_);
  drawn_triangles_ += passes_.renderer.draw(drawables, *planes_);
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

const Framebuffer& GlFrameTarget::picture() const {
  if (!picture_) return *planes_;
  if (!picture_is_made_) passes_.resolve.draw(*view_, *planes_, *picture_);
  picture_is_made_ = true;
  return *picture_;
}

void GlFrameTarget::finish() {
  if (picture_) picture();
  glFinish();
}

}  // namespace triptych
