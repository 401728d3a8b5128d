// What varies over a triangle: colours and shading normals of its corners, interpolated with perspective.
#pragma once

#include "raster/corner_normals.hpp"
#include "raster/geometry_stage.hpp"

#include <cstdint>

namespace triptych {

/// Plain, so that arrays of it cost nothing before they are used.
struct InterpolatedColors {
  /// Products with (x, y, 1), in pixels, are in the proportions of the weights of the corners at a pixel
  /// (Olano and Greer, Triangle scan conversion using 2D homogeneous coordinates, 1997).
  double weights[3][3];
  float corners[3][3];  ///< red, green, blue of each, 0 to 1, times `lit`
  float lit;            ///< the light on the triangle; 1 where normals say it pixel by pixel
  bool bends;
  glm::vec3 normals[3];  ///< of corners, eye space, unit length, if it bends

  /// Channels at the centre of a pixel, 0 to 1. Weights stay within the triangle. light: direction, eye
  /// space.
  void at(int32_t x, int32_t y, const glm::vec3& light, float (&color)[3]) const;
  /// The same without light.
  void base_at(int32_t x, int32_t y, float (&color)[3]) const;

 private:
  /// The sum of the weights, which are left out of the division where it is 0.
  double weights_at(int32_t x, int32_t y, double (&own)[3]) const;
  void color_at(const double (&own)[3], double sum, float (&color)[3]) const;
};

/// How a triangle's chunk is shown: with the colours of its vertices or with that of the material.
struct CornerBase {
  bool vertex_colors;
  glm::vec3 material;  ///< 0 to 1
};
/// lit: what colours are multiplied by. lights: null, or those of a triangle that bends.
InterpolatedColors interpolate_colors(const VertexStage& stage, int width, int height,
                                      const SlotTable::Triangle& shown, const CornerBase& base, float lit,
                                      const CornerLights* lights);

}  // namespace triptych
