// From eye space to clip space, as the vertex stage computes it and as bounds must know it.
#pragma once

#include "scene/camera.hpp"
#include "scene/skeleton.hpp"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace triptych {

/// How one view of one model is projected. Depth is reversed: 1 at the near plane.
///
/// Perspective depth is near / z, so there is no far plane. Orthographic depth must be linear; it falls from
/// 1 to 0 over the model's diagonal, and starts where the model does or at the near plane, whichever is
/// further.
struct ClipSpace {
  /// Positions are taken relative to this point: the eye; orthographic, the point of the view axis that is
  /// nearest to the model's middle, so that precision does not depend on how far away the eye was put.
  glm::dvec3 reference{0};
  /// How deep the reference lies behind the eye plane.
  double reference_depth = 0;
  /// Model units of one unit of eye space on the graphics card: a power of two near the model's size, so
  /// that floats neither overflow nor vanish, whatever units the model is in.
  double unit = 1;
  double near = 1;   ///< where depth is 1, model units from the eye plane
  double range = 0;  ///< orthographic: the distance from there to where depth is 0
  bool orthographic = false;

  /// The depth of a point z model units from the eye plane.
  double depth(double z) const { return orthographic ? 1 - (z - near) / range : near / z; }
};

/// rotation: view.rotation(). model_units: FrameRules::model_units.
ClipSpace clip_space(const Skeleton& skeleton, const View& view, const glm::dmat3& rotation,
                     bool model_units = true);

}  // namespace triptych
