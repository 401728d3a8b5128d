// A body made of bars and round parts, which can be meshed with any number of triangles.
#pragma once

#include "samples/mesh_part.hpp"

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace triptych {

/// Parts of one colour, the most important first: when there are too few triangles, the last are left out.
/// Every part is one closed surface, outward.
class Shape {
 public:
  explicit Shape(const glm::dvec3& colour) : colour_(colour) {}

  void box(const glm::dvec3& low, const glm::dvec3& high);
  /// A straight bar with a rectangular section; `side` is a direction across it, of the width.
  void bar(const glm::dvec3& from, const glm::dvec3& to, double width, double height,
           const glm::dvec3& side = {0, 0, 1});
  /// A hexagonal bolt of 20 triangles that stands on a place.
  void bolt(const glm::dvec3& place, double radius, double height);
  /// A pipe with closed ends, its corners rounded.
  void tube(std::vector<glm::dvec3> line, double radius);
  /// A body turned around an axis (0 x, 1 y, 2 z) through the base. Its profile: how far along, and the
  /// radius there, never 0.
  void turned(const glm::dvec3& base, int axis, const std::vector<glm::dvec2>& profile);
  void cylinder(const glm::dvec3& base, int axis, double length, double radius);

  /// About as many triangles, finer where parts are large; at least one part, as coarse as it can be.
  MeshPart mesh(uint64_t triangles) const;

 private:
  struct Part {
    std::vector<glm::dvec3> points;  ///< a bar's or bolt's corners; a round part's line
    std::vector<double> radii;       ///< by point; empty for bars
    bool bent = false;               ///< a tube: its corners are rounded
  };
  struct Plan;

  Plan plan_for(uint64_t triangles) const;

  glm::dvec3 colour_;
  std::vector<Part> parts_;
};

}  // namespace triptych
