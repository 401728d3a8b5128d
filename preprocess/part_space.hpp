// A placed part's own space and that of the hierarchy that it is in.
#pragma once

#include "preprocess/parts.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

namespace triptych {

struct PartSpace {
  explicit PartSpace(const Affine& to_hierarchy)
      : transform(to_hierarchy), inverse(glm::inverse(glm::dmat3(to_hierarchy))) {
    for (int row = 0; row < 3; ++row)
      shrink = std::max(shrink, glm::length(glm::dvec3(inverse[0][row], inverse[1][row], inverse[2][row])));
  }
  PartSpace(const PlacedParts& hierarchy, uint32_t placed)
      : PartSpace(hierarchy.transforms[hierarchy.placed[placed].transform]) {}

  glm::dvec3 out(const glm::dvec3& point) const { return transform * glm::dvec4(point, 1); }
  glm::dvec3 in(const glm::dvec3& point) const { return inverse * (point - transform[3]); }
  /// In its own space a box that holds this one of the hierarchy's space.
  Box in(const Box& box) const {
    const glm::dvec3 middle = in((box.lo + box.hi) * 0.5), half = (box.hi - box.lo) * 0.5;
    const glm::dvec3 reach =
        glm::abs(inverse[0]) * half.x + glm::abs(inverse[1]) * half.y + glm::abs(inverse[2]) * half.z;
    return {middle - reach, middle + reach};
  }
  /// The other way about.
  Box out(const Box& box) const { return placed_box(transform, box); }
  /// Of a plane with this normal; length 1.
  glm::dvec3 normal_out(const glm::dvec3& normal) const {
    return glm::normalize(glm::transpose(inverse) * normal);
  }

  Affine transform;
  glm::dmat3 inverse;
  double shrink = 0;  ///< no coordinate of its own space changes by more than this for a step of length 1
};

}  // namespace triptych
