// What varies over a triangle: colours and shading normals of its corners, interpolated with perspective.
#pragma once

#include "raster/corner_normals.hpp"
#include "raster/perspective_weights.hpp"
#include "raster/slots.hpp"

#include <cstdint>

namespace triptych {

/// Plain, so that arrays of it cost nothing before they are used.
struct InterpolatedColors {
  PerspectiveWeights weights;
  float corners[3][3];  ///< red, green, blue of each, 0 to 1, times `lit`
  float lit;            ///< the light on the triangle, or 1 where it comes later
  bool bends;
  glm::vec3 normals[3];  ///< of corners, eye space, unit length, if it bends

  /// Channels at the centre of a pixel, 0 to 1. Weights stay within the triangle. Returns the light there if
  /// it bends, which is to be multiplied with them; otherwise 1. light: direction, eye space.
  float at(int32_t x, int32_t y, const glm::vec3& light, float (&color)[3]) const;
  /// The normal there, if it bends: eye space, of unit length.
  glm::vec3 normal_at(int32_t x, int32_t y) const;
  /// The same without light.
  void base_at(int32_t x, int32_t y, float (&color)[3]) const;

 private:
  glm::vec3 normal_by(const double (&own)[3], double sum) const;
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
