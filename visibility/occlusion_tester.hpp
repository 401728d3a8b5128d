// The seam between culling and a device: draws occluders, and answers which rectangles show in front of them.
#pragma once

#include "scene/skeleton.hpp"
#include "visibility/device_margins.hpp"
#include "visibility/screen_bounds.hpp"

#include <cstdint>
#include <span>

namespace triptych {

/// Holds one occlusion representation: the depth of what was drawn under one view.
class OcclusionTester : public ExtentTester {
 public:
  /// Whether test() would say so of every rectangle with these sides and this first plane: for less than a
  /// test. False where that is not known without one.
  bool hides(const ScreenExtent&) const override { return false; }

  /// What bounds of the boxes that are tested here must leave room for.
  virtual DeviceMargins margins() const { return {}; }

  /// Adds the drawables' depth, in the order given.
  virtual void draw(std::span<const DrawableId> drawables) = 0;

  /// Test i covers the rectangles from ends[i − 1] (0 for the first) up to, not including, ends[i].
  /// visible[i] becomes 1 if they are at or in front of the depth at `min_pixels` pixels or more, 0 if at
  /// fewer. Each rectangle's pixels are counted, so those of several may count more than once. min_pixels: at
  /// least 1, which asks whether anything shows. Non-strict, and conservative: where the answer is not known
  /// it is 1, visible.
  virtual void test(std::span<const ScreenRectangle> rectangles, std::span<const uint32_t> ends,
                    uint32_t min_pixels, std::span<uint8_t> visible) = 0;
};

}  // namespace triptych
