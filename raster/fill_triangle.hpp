// What filling a triangle takes: plain data, for code that is compiled once for each instruction set.
#pragma once

#include <cstdint>

namespace triptych {

/// A triangle whose box holds at least one pixel centre of the picture. Pixel (left + i, bottom + j) is
/// covered where all of edge[k] + step_x[k] · i + step_y[k] · j ≥ 0; an edge's own pixels belong to it where
/// it is a left or a top one (y up). Its depth there is
///
///   clamp((z + slope_y · dy) + slope_x · dx, low, high),   dx, dy: sub-pixels from the first corner
///
/// in this order, in floats.
struct FillTriangle {
  int64_t edge[3];
  int32_t step_x[3], step_y[3];
  int32_t left, right, bottom, top;  ///< pixels, inclusive
  int32_t first_x, first_y;          ///< the first corner, sub-pixels
  float z, slope_x, slope_y;         ///< depth there, and what it changes by a sub-pixel
  float low, high;                   ///< the corners' depths
  uint32_t slot;
};

}  // namespace triptych
