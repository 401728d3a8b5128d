// The seam between culling and the graphics card: draws occluders, answers which rectangles show.
#pragma once

#include "scene/skeleton.hpp"
#include "visibility/screen_bounds.hpp"

#include <cstdint>
#include <span>

namespace triptych {

/// Holds one occlusion representation: the depth of what was drawn under one view.
class OcclusionTester {
 public:
  virtual ~OcclusionTester() = default;

  /// Adds the drawables' depth, in the order given.
  virtual void draw(std::span<const DrawableId> drawables) = 0;

  /// visible[i] becomes 1 where rectangle i is at or in front of the depth at some pixel, 0 where it is
  /// behind it at every one. Non-strict, and exact up to answers of 1 too many: unknown means visible.
  virtual void test(std::span<const ScreenRectangle> rectangles, std::span<uint8_t> visible) = 0;
};

}  // namespace triptych
