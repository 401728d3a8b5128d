// What every importer goes by: which coordinates can be used.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>

namespace triptych {

/// Coordinates beyond this are treated as not finite: products of three of them would overflow a double.
inline constexpr double largest_coordinate = 1e75;

/// Written so that NaN is not usable.
inline bool is_usable(const glm::dvec3& position) {
  return std::abs(position.x) <= largest_coordinate && std::abs(position.y) <= largest_coordinate &&
         std::abs(position.z) <= largest_coordinate;
}

}  // namespace triptych
