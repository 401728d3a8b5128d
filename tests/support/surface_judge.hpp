// A second opinion on how far surfaces are apart, quick enough for whole packs: Embree finds candidates,
// distances are double, and no code is shared with the bounds that it judges.
#pragma once

#include "tests/support/corners.hpp"

#include <embree3/rtcore.h>
#include <functional>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

namespace triptych::judge {

/// Triangles that can be asked for the nearest of them. At least one; they may have no area.
class NearestTriangles {
 public:
  explicit NearestTriangles(std::vector<Corners> triangles);
  ~NearestTriangles();
  NearestTriangles(const NearestTriangles&) = delete;
  NearestTriangles& operator=(const NearestTriangles&) = delete;

  /// The least of `limit` and the distance from the point.
  double distance(const glm::dvec3& point, double limit = std::numeric_limits<double>::infinity()) const;
  /// Calls `visit` with the index of every triangle whose box is within the radius, and perhaps of some more.
  void near(const glm::dvec3& point, double radius, const std::function<void(size_t)>& visit) const;
  const std::vector<Corners>& triangles() const { return triangles_; }

 private:
  void query(const glm::dvec3& point, double radius, RTCPointQueryFunction function, void* data) const;

  std::vector<Corners> triangles_;
  glm::dvec3 center_{0};
  double unit_ = 1;    ///< of the tree's floats
  double margin_ = 0;  ///< what rounding to them may do
  RTCDevice device_;
  RTCScene scene_;
};

/// The largest distance from points of these triangles to the others: every corner, and a grid on each
/// triangle with that many steps along a side. A lower bound of the one-sided distance.
double furthest(std::span<const Corners> from, const NearestTriangles& to, int steps);

}  // namespace triptych::judge
