// Shading normals of corners, and the light on what they belong to.
#pragma once

#include "raster/slots.hpp"

#include <cstdint>
#include <glm/vec3.hpp>

namespace triptych {

/// Of the same direction; 0 of one without a direction.
glm::vec3 unit_or_zero(const glm::vec3& v);

/// The light of visibility/shading.hpp on a face with a normal of unit length, of either side, eye space.
float light_on(const glm::vec3& normal, const glm::vec3& light);

/// Of a triangle with shading normals.
struct CornerLights {
  glm::vec3 eye[3];  ///< eye space, unit length; 0 of one without a direction
  /// Whether the light changes over the triangle by as much as can be seen; otherwise `light` is that on it.
  bool bends = false;
  float light = 0;
};

/// Precondition: the triangle's corners have normals. light: direction, eye space.
CornerLights corner_normals(const SlotTable::Triangle& shown, const glm::vec3& light);

}  // namespace triptych
