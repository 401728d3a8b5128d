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

/// Each layer lies below the one on it, along the normal of their plane: by `step`, and by 1/512 of a pixel.
/// The first is what rounding in the vertex stage and in files may make of one plane; moved along its normal,
/// a plane's depth changes by one factor everywhere. The second is what snapping vertices to 1/256 pixel
/// makes of it where triangles of different shapes lie in it; more would let come through what lies close
/// behind (docs/algorithms.md).
struct LayerOffset {
  static constexpr double share_of_distance = 0x1p-21;
  static constexpr float share_of_pixel = 1.0f / 512;

  explicit LayerOffset(const FrameView& view);

  float focal_x, focal_y;  ///< pixels per unit of tangent, or per unit of length
  float axis_x, axis_y;    ///< pixels from the lower left corner
  float step;              ///< as a share of the near plane's distance; orthographic: in model units
  float parallel;          ///< orthographic: what depth changes by in a model unit; otherwise 0

  DepthDrop drop(uint32_t layers, const PixelSlopes& slopes) const {
    const float along_x = slopes.x * focal_x, along_y = slopes.y * focal_y,
                ahead = parallel > 0 ? parallel : slopes.at_axis;
    // What depth changes by over a unit along the normal: at the distance of the plane, near over it.
    const float normal = std::sqrt((along_x * along_x + along_y * along_y) + ahead * ahead);
    const float moved = step * normal, snapped = share_of_pixel / std::max(focal_x, focal_y) * normal;
    const auto count = static_cast<float>(layers);
    if (parallel > 0) return {1, count * (moved + snapped)};
    return {std::max(1 - count * moved, 0.5f), count * snapped};
  }
};

}  // namespace triptych
