// How one placed part stands to another: equal keys for equal parts at equal relative transforms.
#pragma once

#include "preprocess/part_space.hpp"

#include <array>
#include <cmath>
#include <cstdint>

namespace triptych {

/// The part, and its transform from the other's space, axes to a millionth, its origin to a quarter of the
/// tolerance.
using RelativePlace = std::array<int64_t, 13>;

/// own: the placed part that the other one is seen from. tolerance: in the hierarchy's space.
inline RelativePlace relative_place(const PartSpace& own, const PlacedParts& hierarchy, uint32_t other,
                                    double tolerance) {
  const Affine& transform = hierarchy.transforms[hierarchy.placed[other].transform];
  RelativePlace place{hierarchy.placed[other].part};
  for (int column = 0; column < 4; ++column) {
    const glm::dvec3 relative = column < 3 ? own.inverse * transform[column] : own.in(transform[3]);
    const double unit = column < 3 ? 1e-6 : tolerance / 4;
    for (int row = 0; row < 3; ++row)
      place[static_cast<size_t>(1 + 3 * column + row)] = std::llround(relative[row] / unit);
  }
  return place;
}

}  // namespace triptych
