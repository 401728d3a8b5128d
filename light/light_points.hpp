// Where light is gathered: the different corners of a model, of which a place where surfaces of different
// directions meet has several.
#pragma once

#include "light/lit_model.hpp"

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace triptych {

struct LightPoint {
  glm::dvec3 position;    ///< near its place, a little towards the middle of the triangles that have it
  glm::dvec3 normal;      ///< of unit length
  uint32_t instance = 0;  ///< of one of its triangles
};

/// Normals that differ by more than this are of different points.
inline constexpr double crease_cosine = 0.8660254037844386;  // 30°

/// Numbers the corners' points (LitCorner::point). Points come in the order of their places. clearance: by
/// how much they must lie off what ends at their place.
std::vector<LightPoint> make_points(LitModel& model, double clearance);

/// The unit normal of a corner: that of the file, or of the triangle; zero of one without area.
glm::dvec3 corner_normal(const LitModel& model, const LitTriangle& triangle, size_t corner);

}  // namespace triptych
