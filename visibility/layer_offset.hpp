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
/// changes by one factor everywhere (docs/algorithms.md). Where a device snaps vertices before it computes
/// depths, it says so: then triangles of different shapes in one plane are off by what that moves them.
struct LayerOffset {
  static constexpr double share_of_distance = 0x1p-21;
  /// Rounding of depths themselves.
  static constexpr float depth_rounding = 0x1p-20f;  ///< as a share of the depth

  /// snapping: what vertices may move by across the screen before depths are computed, pixels.
  explicit LayerOffset(const FrameView& view, double snapping = 0);

  float focal_x, focal_y;  ///< pixels per unit of tangent, or per unit of length
  float axis_x, axis_y;    ///< pixels from the lower left corner
  float step;              ///< as a share of the near plane's distance; orthographic: in model units
  float snapped;           ///< the same for snapping, as a share of the plane's distance
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
