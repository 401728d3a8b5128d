// Where a box may appear on the screen: the rectangle and the nearest depth that the occlusion test uses.
#pragma once

#include "scene/camera.hpp"
#include "scene/skeleton.hpp"
#include "visibility/clip_space.hpp"

#include <cstdint>

namespace triptych {

/// A rectangle in normalised device coordinates (−1 to 1, y up) and a depth in 0 to 1, reversed: 1 at the
/// near plane, 0 at infinity. No fragment of the box's content lies outside the rectangle. Every pass drops
/// fragments nearer than `depth`, so no drawn fragment is nearer than it: wherever the content is the nearest
/// thing, a non-strict test of the rectangle passes. That is what makes culling exact (docs/algorithms.md has
/// the argument).
struct ScreenRectangle {
  float left = -1, bottom = -1, right = 1, top = 1;
  float depth = 1;
};

struct ScreenBounds {
  enum class Kind : uint8_t {
    off_screen,  ///< covers no pixel centre
    unbounded,   ///< touches the near plane, or its projection is not known well enough: visible without a
                 ///< test
    rectangle,   ///< the rectangle holds
  };
  Kind kind = Kind::unbounded;
  ScreenRectangle rectangle;
};

/// Projects boxes of the model lattice under one view. Derived margins: the rectangle grows by one pixel on
/// each side (sub-pixel snapping is at most 1/16 pixel by the OpenGL minimum, and the vertex stage's rounding
/// is bounded), by more where views are so narrow that rounding is beyond a quarter of a pixel; the depth
/// moves towards the eye by 2⁻¹⁴ of itself, orthographic of its range (float rounding of w and z).
class BoxProjector {
 public:
  BoxProjector(const Skeleton& skeleton, const View& view);
  ScreenBounds bounds(const LatticeBox& box) const;

 private:
  ScreenBounds perspective_bounds(const Box& box) const;
  ScreenBounds parallel_bounds(const Box& box) const;
  ScreenBounds on_screen(double left, double right, double bottom, double top, double depth,
                         double rounding) const;

  const Lattice& lattice_;
  View view_;
  ClipSpace clip_;
  glm::dmat3 rotation_;
};

}  // namespace triptych
