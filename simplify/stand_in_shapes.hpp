// The shapes that stand in for small convex things, before they are placed.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace triptych {

/// Corners in a box of side 2 about 0, and triangles, counter-clockwise from outside.
struct StandInShape {
  std::vector<glm::dvec3> corners;
  std::vector<std::array<uint32_t, 3>> triangles;
};

/// Along z, with so many sides; the angle, radians, of its first corner.
StandInShape prism(uint32_t sides, double first_angle);
/// The same with its upper corners turned by half a side: nearer to what is round, from most directions.
StandInShape antiprism(uint32_t sides, double first_angle);
StandInShape tetrahedron();

/// Of the shape, scaled along its axes.
double area_of(const StandInShape& shape, const glm::dvec3& scale);
/// The factor for what lies across the shape's z, or for all of it, at which it has so much area; `reach`:
/// its scale beside that. Negative if there is none up to 4.
double scale_for(const StandInShape& shape, const glm::dvec3& reach, bool in_all, double area);

/// How far the hulls of two sets of points reach beyond each other, on average over all directions: by how
/// much their outlines differ, roughly. In their units.
double mean_difference(std::span<const glm::ivec3> a, std::span<const glm::ivec3> b);

/// Directions of length 1 along which points of this covariance vary independently (principal components, by
/// Jacobi's rotations).
std::array<glm::dvec3, 3> principal_axes(const std::array<glm::dvec3, 3>& covariance);

}  // namespace triptych
