// Colours that vary over a triangle: those of its corners, interpolated with perspective.
#pragma once

#include "raster/perspective_weights.hpp"
#include "raster/slots.hpp"

#include <cstdint>

namespace triptych {

/// Plain, so that arrays of it cost nothing before they are used.
struct InterpolatedColors {
  PerspectiveWeights weights;
  float corners[3][3];  ///< red, green, blue of each, 0 to 1, lit

  /// Channels at the centre of a pixel, 0 to 1. Weights stay within the triangle.
  void at(int32_t x, int32_t y, float (&color)[3]) const;
};

/// Of a triangle of a chunk that has colours. lit: what they are multiplied by.
InterpolatedColors interpolate_colors(const VertexStage& stage, int width, int height,
                                      const SlotTable::Triangle& shown, float lit);

}  // namespace triptych
