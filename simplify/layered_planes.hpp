// The planes in which faces of several colours lie on each other: what is in one must stay in it, or what it
// lies on comes through.
#pragma once

#include "simplify/surface.hpp"

#include <algorithm>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace triptych {

/// Planes of triangles that have layers (scene/layers.hpp), and which points of a surface are corners there.
class LayeredPlanes {
 public:
  /// None.
  LayeredPlanes() = default;
  static const LayeredPlanes& none();
  /// Those of the surface.
  explicit LayeredPlanes(const Surface& surface);
  /// The same planes, for a surface whose points are these points of the one that this is about.
  LayeredPlanes of(std::span<const uint32_t> sources) const;

  bool empty() const { return planes_.empty(); }
  /// The planes that the point lies in, ascending.
  std::span<const uint32_t> planes_of(uint32_t point) const { return sets_[set_of_[point]]; }
  bool is_in(uint32_t point, uint32_t plane) const {
    const auto planes = planes_of(point);
    return std::find(planes.begin(), planes.end(), plane) != planes.end();
  }
  /// How large what lies on others in the plane is altogether: two and a half times the side of a square of
  /// its area, lattice steps. Levels whose error is below that must not let it vanish: then it covers more
  /// than a sixth of a pixel where the error is one.
  double size_of(uint32_t plane) const { return planes_[plane].size; }
  /// On which side of the plane a place is, negative for one of them; lattice steps.
  double height(uint32_t plane, const glm::dvec3& place) const;

  /// The size of the largest plane that a point leaves which goes to where `target` is; 0 if none.
  double left(uint32_t point, uint32_t target) const;
  /// The size of the largest plane into which that lays the triangle of the point, a and b; 0 if none.
  double entered(uint32_t point, uint32_t target, uint32_t a, uint32_t b) const;
  /// What of a way leads along the plane.
  glm::dvec3 along(uint32_t plane, const glm::dvec3& way) const;
  /// What of a way keeps the point in its planes.
  glm::dvec3 within(uint32_t point, const glm::dvec3& way) const;

 private:
  struct Plane {
    glm::dvec3 point{0}, normal{0};  ///< of length 1
    double size = 0;
  };
  class Finder;

  std::vector<Plane> planes_;
  std::vector<std::vector<uint32_t>> sets_;  ///< of planes; 0: none
  std::vector<uint32_t> set_of_;             ///< for each point
};

}  // namespace triptych
