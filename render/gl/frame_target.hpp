// A frame target of OpenGL: a framebuffer, and the passes that draw into it and test against it.
#pragma once

#include "render/gl/framebuffer.hpp"
#include "render/gl/line_pass.hpp"
#include "render/gl/rectangle_test.hpp"
#include "render/gl/renderer.hpp"
#include "visibility/frame_target.hpp"

#include <optional>

namespace triptych {

class GlFrameTarget final : public FrameTarget {
 public:
  GlFrameTarget(Renderer& renderer, RectangleTest& rectangles, LinePass& lines, TargetKind kind, int width,
                int height);

  int width() const override { return framebuffer_.width(); }
  int height() const override { return framebuffer_.height(); }
  TargetKind kind() const override { return framebuffer_.kind(); }
  void begin(const FrameView& view) override;
  void draw(std::span<const DrawableId> drawables) override;
  void test(std::span<const ScreenRectangle> rectangles, std::span<const uint32_t> ends, uint32_t min_pixels,
            std::span<uint8_t> visible) override;
  void finish() override;
  uint64_t drawn_triangles() const override { return drawn_triangles_; }
  void draw_lines(std::span<const ScreenLine> lines) override { lines_.draw(lines, framebuffer_); }
  std::vector<uint8_t> read_colors() const override { return framebuffer_.read_colors(); }
  std::vector<uint32_t> read_items() const override { return framebuffer_.read_items(); }
  bool copy_to_window(int window_width, int window_height) const override {
    framebuffer_.copy_to_window(window_width, window_height);
    return true;
  }

 private:
  Renderer& renderer_;
  RectangleTest& rectangles_;
  LinePass& lines_;
  Framebuffer framebuffer_;
  std::optional<FrameView> view_;
  uint64_t drawn_triangles_ = 0;
};

}  // namespace triptych
