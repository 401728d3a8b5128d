// What share each corner of a triangle has in a pixel.
#pragma once

#include "raster/vertex_stage.hpp"

#include <cstdint>

namespace triptych {

/// Products with (x, y, 1), in pixels, are in the proportions of the weights of the corners at a place (Olano
/// and Greer, Triangle scan conversion using 2D homogeneous coordinates, 1997). Plain, so that arrays of it
/// cost nothing before they are used.
struct PerspectiveWeights {
  double of_corner[3][3];

  /// At a place in the picture, in pixels, each within 0 to 1; their sum, which is 0 where the triangle has
  /// no area. At an edge, or of a triangle seen from its edge, a pixel's centre may lie a little outside.
  double clamped_at(double x, double y, double (&weights)[3]) const;
  /// How a value that the corners have changes there, by a pixel to the right, and by one up. value: its own
  /// there.
  void change(double x, double y, const double (&of_corners)[3], double value, double& right,
              double& up) const;
};

PerspectiveWeights perspective_weights(const VertexStage& stage, int width, int height,
                                       const PlacedLattice& placed, const RasterChunk& chunk,
                                       uint32_t triangle);

}  // namespace triptych
