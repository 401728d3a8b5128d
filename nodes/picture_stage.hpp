// What the render node does with its device: draw the visible set, in draw rank order.
#pragma once

#include "visibility/device.hpp"

#include <memory>
#include <span>

namespace triptych {

/// Draws pictures (or item buffers) of one size.
class PictureStage {
 public:
  PictureStage(Device& device, int width, int height, TargetKind kind = TargetKind::color);

  /// frame: its number, for the timeline.
  void begin(const FrameView& view, uint32_t frame = 0);
  /// Draws more of the frame. Over one frame, drawables come in draw rank order.
  void draw(std::span<const DrawableId> drawables);
  /// Waits until everything is drawn, so that a wall clock can time it.
  void finish();

  uint64_t drawn_triangles() const { return target_->drawn_triangles(); }
  FrameTarget& target() { return *target_; }
  const FrameTarget& target() const { return *target_; }

 private:
  std::unique_ptr<FrameTarget> target_;
  uint32_t frame_ = 0;
};

}  // namespace triptych
