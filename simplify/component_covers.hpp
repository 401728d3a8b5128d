// How much of the screen the components of a surface cover.
#pragma once

#include "simplify/surface.hpp"

#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

namespace triptych {

/// A connected component of a surface, as something that covers a part of the screen.
struct Cover {
  /// On average over all directions, from afar, square lattice steps: a quarter of the area of what is closed
  /// (Cauchy), half of what is flat, in between by how much its normals cancel. What hides itself otherwise
  /// is not counted.
  double covered = 0;
  double area = 0, flatness = 0;  ///< flatness: 0 where normals cancel, 1 where all are the same
  glm::dvec3 middle{0};           ///< of its area
  double radius = 0;              ///< no point is further from the middle
  double thickness = 0;           ///< roughly the radius of its cross sections; that of a ball is its radius
  uint32_t material = 0;          ///< palette_index() of its largest triangle
  /// Whether it is much longer than thick, as a wire is: then what is across is looked for place by place.
  bool is_long() const;
  /// The radius of a round rod of this length and area; of a panel about its width.
  double across() const;
  /// Whether it is much longer than that, as no panel is.
  bool is_rod() const;
  /// Whether it is so much longer that it is thinner than a pixel where its length still shows.
  bool is_wire() const;
};

struct ComponentCovers {
  explicit ComponentCovers(const Surface& surface);

  std::vector<uint32_t> component_of;  ///< for each point, numbered in order of appearance
  std::vector<Cover> covers;           ///< of the components
};

/// The cover of triangles with this area whose normals, as long as their areas are large, have this sum.
double mean_cover(double area, const glm::dvec3& normals);

/// The surface's triangle's normal, as long as its area is large; corners as given.
inline glm::dvec3 area_normal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return glm::cross(b - a, c - a) / 2.0;
}

}  // namespace triptych
