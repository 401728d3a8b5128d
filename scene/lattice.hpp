// The integer lattice that positions live on: one for the model, one for each mesh that is placed more than
// once.
#pragma once

#include "scene/box.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace triptych {

/// position = origin + step · point, exactly in double arithmetic: the step is a power of two and the origin
/// a multiple of it. Points stay within ±2^29, so that differences of two fit 32 bits.
struct Lattice {
  glm::dvec3 origin{0};
  double step = 1;

  static constexpr int limit = 1 << 29;

  glm::dvec3 position(const glm::ivec3& point) const { return origin + step * glm::dvec3(point); }
  /// The nearest lattice point; off by at most step · √3 / 2.
  glm::ivec3 nearest(const glm::dvec3& position) const {
    return glm::ivec3(glm::round((position - origin) / step));
  }
  /// The smallest lattice box that holds the box.
  LatticeBox enclosing(const Box& box) const {
    LatticeBox around{glm::ivec3(glm::floor((box.lo - origin) / step)),
                      glm::ivec3(glm::ceil((box.hi - origin) / step))};
    for (int axis = 0; axis < 3; ++axis) {  // the difference may have been rounded inwards
      if (position(around.lo)[axis] > box.lo[axis]) --around.lo[axis];
      if (position(around.hi)[axis] < box.hi[axis]) ++around.hi[axis];
    }
    return around;
  }
  Box box(const LatticeBox& box) const { return {position(box.lo), position(box.hi)}; }
  /// The largest distance between a position and its nearest lattice point.
  double rounding() const { return step * std::sqrt(3.0) / 2; }
  bool operator==(const Lattice&) const = default;
};

/// A lattice of about 2^bits cells along the longest side of the box, centred on it to an eighth of that.
Lattice make_lattice(const Box& box, int bits);

}  // namespace triptych
