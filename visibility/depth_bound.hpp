// How near a box's content may come to the eye, pixel by pixel.
#pragma once

#include "lod/frame_view.hpp"
#include "visibility/device_margins.hpp"

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace triptych {

/// A depth (reversed: 1 at the near plane) that is affine over the screen, as that of a plane is in every
/// projection: slope · p + middle at p in normalised device coordinates (−1 to 1, y up).
struct DepthPlane {
  glm::vec2 slope{0};
  float middle = 1;
  float at(float x, float y) const { return slope.x * x + slope.y * y + middle; }
};

/// How far rounding of w, of z and of their quotient may change a depth, as a share of the depth itself;
/// orthographic: of the range of depths.
inline constexpr double share_of_depth = 0x1p-14;

/// How far evaluating a plane in floats may be off, as a share of the sum of its terms; the graphics card's
/// own rounding included.
inline constexpr double plane_rounding = 0x1p-20;

/// What every pass holds its fragments to: those in front of `nearest`, or of any of the planes, are moved
/// back. Planes that hold nothing back are 1 everywhere.
struct DepthBound {
  float nearest = 1;
  std::array<DepthPlane, 3> planes;
};

/// DepthBound over pixels (0 to width and height, centres at 0.5): for each of the planes its slopes and what
/// there is at (0, 0). Last, in `at.w`, `nearest`. Laid out as shaders read it.
struct PixelDepthBound {
  glm::vec4 x{0}, y{0}, at{1};
};
static_assert(sizeof(PixelDepthBound) == 48);
PixelDepthBound pixel_bound(const DepthBound& bound, int width, int height);

/// The planes of the box's faces that look at the eye, at most one per axis: everything in the box lies
/// behind each of them. In normalised device coordinates they are affine because depth is near / z, or
/// linear in z.
class FacePlanes {
 public:
  FacePlanes(const FrameView& view, const DeviceMargins& margins);

  /// The planes, each moved towards the eye by `slack` times as much as rounding and snapping may make
  /// content seem to be in front of it. So planes of slack 2 are in front of those of slack 1 on any
  /// machine, also of those of slack 1 of every box within this one.
  std::array<DepthPlane, 3> of(const Box& model_box, double slack) const;

 private:
  DepthPlane perspective(int axis, const Box& box, double slack) const;
  DepthPlane parallel(int axis, const Box& box, double slack) const;
  DepthPlane with_slack(const glm::dvec2& slope, double middle, double rounding, double slack) const;

  View view_;
  ClipSpace clip_;
  glm::dmat3 rotation_;
  double snapping_;  ///< DeviceMargins::plane
  double stretch_;   ///< of rays against the view axis, at most
  double tiny_;      ///< distances below this one are not known to a share of 2⁻¹⁶
};

}  // namespace triptych
