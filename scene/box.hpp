// Axis-aligned boxes, inclusive on both sides.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace triptych {

/// Corners lo and hi belong to the box; a box that holds nothing has lo > hi.
template <typename Vector>
struct BasicBox {
  using Scalar = typename Vector::value_type;
  Vector lo{std::numeric_limits<Scalar>::max()};
  Vector hi{std::numeric_limits<Scalar>::lowest()};

  bool empty() const { return lo.x > hi.x || lo.y > hi.y || lo.z > hi.z; }
  void extend(const Vector& point) {
    lo = glm::min(lo, point);
    hi = glm::max(hi, point);
  }
  void extend(const BasicBox& box) {
    lo = glm::min(lo, box.lo);
    hi = glm::max(hi, box.hi);
  }
  bool contains(const BasicBox& box) const {
    return lo.x <= box.lo.x && lo.y <= box.lo.y && lo.z <= box.lo.z && hi.x >= box.hi.x && hi.y >= box.hi.y &&
           hi.z >= box.hi.z;
  }
  /// Corner i of 8: bit 0 chooses x, bit 1 y, bit 2 z.
  Vector corner(int i) const { return {i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z}; }
  /// 0 for x, 1 for y, 2 for z; the first of several that are equally long. The box must not be empty.
  int longest_axis() const {
    const Vector size = hi - lo;
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  }
  bool operator==(const BasicBox&) const = default;
};

using Box = BasicBox<glm::dvec3>;         ///< model or mesh space, doubles
using LatticeBox = BasicBox<glm::ivec3>;  ///< lattice coordinates

inline glm::dvec3 center(const Box& box) { return (box.lo + box.hi) * 0.5; }

/// Half of the surface area, to which the chance that a random ray hits the box is proportional. The box must
/// not be empty.
inline double half_area(const Box& box) {
  const glm::dvec3 size = box.hi - box.lo;
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

/// The length of the box's diagonal. The box must not be empty.
inline double diagonal(const Box& box) { return glm::length(box.hi - box.lo); }

}  // namespace triptych
