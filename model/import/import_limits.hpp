// Rules of all importers: which coordinates can be used, and the warning for others.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>

namespace triptych {

/// The warning for triangles whose coordinates cannot be used.
inline constexpr const char* not_finite_warning = "triangles were dropped: their coordinates are not finite";

/// Coordinates beyond this are treated as not finite: products of three of them would overflow a double.
inline constexpr double max_import_coordinate = 1e75;

/// Written so that NaN is not usable.
inline bool is_usable(const glm::dvec3& position) {
  return std::abs(position.x) <= max_import_coordinate && std::abs(position.y) <= max_import_coordinate &&
         std::abs(position.z) <= max_import_coordinate;
}

}  // namespace triptych
