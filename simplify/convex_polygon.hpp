// Convex polygons in space, cut by planes.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

namespace triptych {

/// A convex polygon. Each cut adds at most one corner, and sequences of cuts are short; a polygon that has
/// become too large is not cut.
class ConvexPolygon {
 public:
  static constexpr size_t max_corners = 15;
  void push_back(const glm::dvec3& corner) { corners_[size_++] = corner; }
  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  void clear() { size_ = 0; }
  const glm::dvec3& operator[](size_t i) const { return corners_[i]; }
  const glm::dvec3* begin() const { return corners_.data(); }
  const glm::dvec3* end() const { return corners_.data() + size_; }
  operator std::span<const glm::dvec3>() const { return {corners_.data(), size_}; }

 private:
  std::array<glm::dvec3, max_corners + 2> corners_;
  size_t size_ = 0;
};

glm::dvec3 middle_of(const ConvexPolygon& polygon);

/// Cuts off what lies beyond the plane dot(normal, x) = limit and returns it; both stay convex, either may be
/// empty. A strip narrower than `narrow` is not cut off.
ConvexPolygon cut(ConvexPolygon& polygon, const glm::dvec3& normal, double limit, double narrow);

}  // namespace triptych
