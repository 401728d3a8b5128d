// A frame target of OpenGL: a framebuffer, and the passes that draw into it and test against it.
#pragma once

#include "render/gl/framebuffer.hpp"
#include "render/gl/line_pass.hpp"
#include "render/gl/rectangle_test.hpp"
#include "render/gl/renderer.hpp"
#include "render/gl/resolve_pass.hpp"
#include "render/gl/sky_pass.hpp"
#include "visibility/frame_target.hpp"

#include <optional>
#include <vector>

namespace triptych {

/// The passes that all targets of a device share.
struct GlPasses {
  Renderer renderer;
  RectangleTest rectangles;
  LinePass lines;
  ResolvePass resolve;
  FragmentLists lists;
  SkyPass sky;
};

/// Colours of one sample a pixel, without edges and without anything transparent, are drawn where they are
/// read. Otherwise there are planes, one for each sample, and the picture is made of them when somebody wants
/// it.
class GlFrameTarget final : public FrameTarget {
 public:
  GlFrameTarget(GlPasses& passes, TargetKind kind, int width, int height);

  int width() const override { return planes_->width(); }
  int height() const override { return planes_->height(); }
  TargetKind kind() const override { return planes_->kind(); }
  void begin(const FrameView& view) override;
  void draw(std::span<const DrawableId> drawables) override;
  void test(std::span<const ScreenRectangle> rectangles, std::span<const uint32_t> ends, uint32_t min_pixels,
            std::span<uint8_t> visible) override;
  void finish() override;
  uint64_t drawn_triangles() const override { return drawn_triangles_; }
  void draw_lines(std::span<const ScreenLine> lines) override { passes_.lines.draw(lines, picture()); }
  std::vector<uint8_t> read_colors() const override { return picture().read_colors(); }
  std::vector<uint32_t> read_items(uint32_t sample) const override { return planes_->read_items(sample); }
  VisibleSet transparent_owners() const override;
  std::span<const EffectUse> effects() const override { return effects_; }
  bool copy_to_window(int window_width, int window_height) const override {
    picture().copy_to_window(window_width, window_height);
    return true;
  }

 private:
  const Framebuffer& picture() const;
  void draw_transparent(VisibleSet* owners) const;
  void test_plane(uint32_t plane, const SamplePlace& place, std::span<const ScreenRectangle> rectangles,
                  std::span<const uint32_t> ends, uint32_t min_pixels, std::span<uint8_t> visible);

  GlPasses& passes_;
  std::optional<Framebuffer> planes_;
  mutable std::optional<Framebuffer> picture_;  ///< made of the planes, where they are not the picture
  mutable bool picture_is_made_ = false;
  mutable std::vector<DrawableId> transparent_;  ///< those drawn that have something transparent
  mutable std::vector<EffectUse> effects_;       ///< of the picture
  EffectUse sky_use_;                            ///< no draws: it is not shown
  std::optional<FrameView> view_;
  uint64_t drawn_triangles_ = 0;
  // Of tests that no plane has passed so far.
  std::vector<ScreenRectangle> open_rectangles_;
  std::vector<uint32_t> open_ends_, open_tests_;
  std::vector<uint8_t> open_visible_;
};

}  // namespace triptych
