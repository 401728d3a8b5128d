// Distances, angles and areas between places of a model. Pure; any one unit of length.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// At b, from a to c, degrees from 0 to 180; 0 where two of them are one place.
double angle_degrees(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// A closed polygon, its last corner joined with its first.
struct PolygonSize {
  double area = 0;       ///< of its projection on the plane that makes that largest (Newell's normal)
  double perimeter = 0;  ///< its length
  double off_plane = 0;  ///< how far the corner furthest from that plane through their middle lies from it
};
/// Of at least three corners; computed relative to the first, so that no digits are lost far from the origin.
PolygonSize polygon_size(std::span<const glm::dvec3> corners);

/// The length of a line from corner to corner.
double path_length(std::span<const glm::dvec3> corners);

/// What a person has measured so far: places one after the other, model space.
struct Measured {
  std::vector<glm::dvec3> points;
  bool closed = false;  ///< a polygon, of at least three points
  /// From the point before the last to the plane of the face that the last one lies on, model units.
  std::optional<double> to_face = {};
  bool operator==(const Measured&) const = default;
};

/// A number of a length, area or coordinate for people: to a thousandth, with less for large ones, and in
/// powers of ten where it is small or huge.
std::string number_text(double number);

}  // namespace triptych
