// How far a fan of triangles is from the star that it replaces: the bound of one edge collapse.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace triptych {

/// The triangles around a point, or those between two of its edges, seen along a direction. Corners are
/// relative to the point, in the order of the turn around it; triangle i of the star is (point, corner i,
/// corner i + 1). A star that is closed goes on from the last corner to the first; in one that is open, the
/// point lies on the line from the last corner to the first.
///
/// Where star and fan are both height functions over one polygon, the largest difference of heights bounds
/// their two-sided distance: along the direction each point of one lies over one of the other (Cohen, Manocha
/// and Olano, Simplifying polygonal models using successive mappings, 1997). Differences are linear between
/// the edges of both, so they are largest where two edges cross, or at the point itself.
class ProjectedStar {
 public:
  /// Looks along `direction`, of any length. False if the star is not a height function: not all triangles
  /// turn the same way, or they turn more than once around. Corners: differences of lattice points, rounded
  /// once at most; at least three.
  bool project(std::span<const glm::dvec3> corners, bool closed, const glm::dvec3& direction);

  /// After a successful projection: replaces the star by the fan from corner `apex` to all others; in an open
  /// star the apex is the first or the last corner. `star_errors` says for each triangle of the star a bound
  /// of its points' distance from the source; fan_errors[i] becomes the same for the triangle (apex, corner
  /// i, corner i + 1) of the fan, rounding included. False if the fan is not a height function.
  bool fan_errors(size_t apex, std::span<const double> star_errors, std::span<double> fan_errors);

 private:
  struct Corner {
    double x, y, height, length;  ///< length: in space
  };
  bool errors_from_first(const Corner* corners);

  std::vector<Corner> corners_;   ///< twice around, so that any corner can be the first
  std::vector<Corner> mirrored_;  ///< from the last to the first
  std::vector<double> errors_, carried_, gaps_, over_triangles_;
  size_t size_ = 0;
  double reach_ = 0;  ///< of the furthest corner
  bool closed_ = false;
};

}  // namespace triptych
