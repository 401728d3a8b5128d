// Closest-point queries on triangles, in double: a bounding volume tree split at medians.
#pragma once

#include "scene/box.hpp"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace triptych {

using Corners = std::array<glm::dvec3, 3>;

/// The point of the triangle that is closest to p (Ericson, Real-Time Collision Detection, 2004,
/// section 5.1.5). The result is a convex combination of the corners whatever rounding does, so its distance
/// never comes out too small.
glm::dvec3 closest_point(const glm::dvec3& p, const Corners& triangle);

class TriangleTree {
 public:
  struct Nearest {
    double squared_distance;
    uint32_t triangle;  ///< index into the triangles
  };

  /// At least one triangle.
  explicit TriangleTree(std::vector<Corners> triangles);

  const Corners& triangle(uint32_t index) const { return triangles_[index]; }
  /// The triangle closest to the point. `hint`: the triangle to look at first. Any triangle within the
  /// distance `squared_enough` may be returned.
  Nearest nearest(const glm::dvec3& point, uint32_t hint = 0, double squared_enough = 0) const;
  /// A triangle that has all points within the distance (and so, since it is convex, all their convex
  /// combinations), with the largest of their squared distances from it; no_triangle if there is none.
  Nearest within(std::span<const glm::dvec3> points, double squared_distance) const;
  /// The largest squared distance of the points from one triangle.
  double squared_distance(std::span<const glm::dvec3> points, uint32_t triangle) const;

  static constexpr uint32_t no_triangle = 0xffffffffu;

 private:
  struct Node {
    Box box;
    /// Of a leaf: triangles in order_; of an inner node: count 0 and its right child.
    uint32_t first = 0, count = 0;
  };

  void build(uint32_t first, uint32_t end, std::vector<glm::dvec3>& centers);

  std::vector<Corners> triangles_;
  std::vector<uint32_t> order_;
  std::vector<Node> nodes_;  ///< depth first: a left child follows its parent
};

}  // namespace triptych
