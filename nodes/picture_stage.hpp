// What the render node does with its graphics card: draw the visible set, in draw rank order.
#pragma once

#include "nodes/occlusion_stage.hpp"
#include "render/target.hpp"

#include <vector>

namespace triptych {

/// Draws pictures (or item buffers) of one size.
class PictureStage {
 public:
  PictureStage(Renderer& renderer, int width, int height, TargetKind kind = TargetKind::color);

  /// frame: its number, for the timeline.
  void begin(const View& view, uint32_t frame = 0);
  /// Draws more of the frame. Over one frame, drawables come in draw rank order.
  void draw(const std::vector<DrawableId>& drawables);
  /// Waits until everything is drawn, so that a wall clock can time it.
  void finish();

  uint64_t drawn_triangles() const { return drawn_triangles_; }
  uint64_t drawn_drawables() const { return drawn_drawables_; }
  const Target& target() const { return target_; }

 private:
  Renderer& renderer_;
  Target target_;
  TargetKind kind_;
  uint64_t drawn_triangles_ = 0, drawn_drawables_ = 0;
  uint32_t frame_ = 0;
};

}  // namespace triptych
