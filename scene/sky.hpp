// The sky of a frame: where the sun stands.
#pragma once

#include <glm/vec3.hpp>

namespace triptych {

/// What is behind everything, and where light comes from. Its colours follow from the sun's direction
/// (visibility/sky_look.hpp).
struct Sky {
  bool shown = false;    ///< otherwise the background is of one colour, and light comes from a fixed place
  glm::dvec3 to_sun{0};  ///< model space, of length 1, y up; 0 where the sky is not shown
  bool operator==(const Sky&) const = default;
};

}  // namespace triptych
