// The three corners of a triangle, for what judges geometry.
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace triptych::judge {

using Corners = std::array<glm::dvec3, 3>;

}  // namespace triptych::judge
