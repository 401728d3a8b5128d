#include "render/gl/frame_target.hpp"

#include "base/error.hpp"

namespace triptych {

GlFrameTarget::GlFrameTarget(Renderer& renderer, RectangleTest& rectangles, LinePass& lines, TargetKind kind,
                             int width, int height)
    : renderer_(renderer), rectangles_(rectangles), lines_(lines), framebuffer_(kind, width, height) {}

void GlFrameTarget::begin(const FrameView& view) {
  if (view.view().width != width() || view.view().height != height()) {
    fail("frame target", "a viewport of {}x{} where {}x{} was agreed", view.view().width, view.view().height,
         width(), height());
  }
  view_ = view;
  framebuffer_.clear();
  drawn_triangles_ = 0;
}

void GlFrameTarget::draw(std::span<const DrawableId> drawables) {
  renderer_.set_view(*view_);
  drawn_triangles_ += renderer_.draw(drawables, framebuffer_);
}

void GlFrameTarget::test(std::span<const ScreenRectangle> rectangles, std::span<const uint32_t> ends,
                         uint32_t min_pixels, std::span<uint8_t> visible) {
  rectangles_.test(framebuffer_, view_->rules.non_strict_test ? GL_GEQUAL : GL_GREATER, rectangles, ends,
                   min_pixels, visible);
}

void GlFrameTarget::finish() { glFinish(); }

}  // namespace triptych
