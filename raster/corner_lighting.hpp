// The baked light of corners, interpolated over a triangle, and how it shades.
#pragma once

#include "raster/corner_normals.hpp"
#include "raster/perspective_weights.hpp"
#include "raster/slots.hpp"

#include <cstdint>
#include <glm/vec3.hpp>

namespace triptych {

/// The fixed light of visibility/shading.hpp in two parts: from one direction, and from all around.
struct LightParts {
  float directed = 0, ambient = 0;
};
/// On a face with this normal, eye space, of unit length.
LightParts parts_of_light(const glm::vec3& normal, const glm::vec3& light);

/// Plain, so that arrays of it cost nothing before they are used.
struct CornerLighting {
  float irradiance[3][3];  ///< red, green, blue of each corner: 1 shows white as white
  float openness[3];
  LightParts parts;  ///< where normals of corners do not bend

  struct At {
    float irradiance[3];
    float openness;
  };
  /// At the centre of a pixel. Weights stay within the triangle.
  At at(const PerspectiveWeights& weights, int32_t x, int32_t y) const;
};

/// Of a triangle of a chunk that has baked light.
CornerLighting corner_lighting(const SlotTable::Triangle& shown);

}  // namespace triptych
