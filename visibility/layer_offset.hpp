// How far surfaces that others lie on in their plane (scene/layers.hpp) are moved away from the eye.
#pragma once

#include "lod/frame_view.hpp"

#include <algorithm>
#include <cmath>

namespace triptych {

/// A depth plane over the window: what depth changes by from pixel to pixel, and where the view axis is.
struct PixelSlopes {
  float x = 0, y = 0;
  float at_axis = 0;
};

/// What becomes of depths d under a number of layers: max(d · keep − drop, d / 2). So content only moves
/// away, and what hides it, or boxes that hold it, stay in front.
struct DepthDrop {
  float keep = 1, drop = 0;
  float apply(float depth) const { return std::max(depth * keep - drop, depth * 0.5f); }
};

/// Each layer lies below the one on it, along the normal of their plane: by `step`, which is more than what
/// rounding in the vertex stage and in files makes of one plane. Moved along its normal, a plane's depth
/// changes by one factor everywhere (docs/algorithms.md). Vertices are snapped before depths are computed,
/// which moves triangles of different shapes in one plane differently: devices take their depths from the
/// plane, and say what that leaves of the difference.
struct LayerOffset {
  static constexpr double share_of_distance = 0x1p-21;
  /// Rounding of depths themselves.
  static constexpr float depth_rounding = 0x1p-20f;  ///< as a share of the depth
  /// What vertices may move by across the screen, pixels: as a rule graphics cards snap to 1/256.
  static constexpr double most_snapping = 1.0 / 192;
  /// What is left of that where the plane comes from interpolated positions, in single precision.
  static constexpr double rest_of_snapping = 1.0 / 16;

  /// rest: the share of snapping that is left.
  explicit LayerOffset(const FrameView& view, double rest = 0);

  float focal_x, focal_y;  ///< pixels per unit of tangent, or per unit of length
  float axis_x, axis_y;    ///< pixels from the lower left corner
  float step;              ///< as a share of the near plane's distance; orthographic: in model units
  float snapping;          ///< the same for most_snapping, as a share of the plane's distance
  float snapped;           ///< and for what is left of it
  float parallel;          ///< orthographic: what depth changes by in a model unit; otherwise 0

  /// Of this many layers, not counting the uppermost.
  DepthDrop drop(uint32_t layers, const PixelSlopes& slopes) const {
    const float along_x = slopes.x * focal_x, along_y = slopes.y * focal_y,
                ahead = parallel > 0 ? parallel : slopes.at_axis;
    // What depth changes by over a unit along the normal: at the distance of the plane, near over it.
    const float normal = std::sqrt((along_x * along_x + along_y * along_y) + ahead * ahead);
    const float moved = step * normal, sheared = snapped * normal;
    const auto count = static_cast<float>(layers);
    if (parallel > 0) return {1 - count * depth_rounding, count * (moved + sheared)};
    return {std::max(1 - count * (moved + depth_rounding), 0.5f), count * sheared};
  }
};

}  // namespace triptych
