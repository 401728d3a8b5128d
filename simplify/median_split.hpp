// Orders points along an axis, and splits them in two at the median.
#pragma once

#include "scene/box.hpp"

#include <algorithm>
#include <cstdint>
#include <span>

namespace triptych {

/// Indices in the order of their points; of equal coordinates the smaller index comes first.
struct AlongAxis {
  std::span<const glm::dvec3> points;
  int axis;
  bool operator()(uint32_t a, uint32_t b) const {
    return points[a][axis] != points[b][axis] ? points[a][axis] < points[b][axis] : a < b;
  }
};

/// Moves the index range.size() / 2 of the order along the longest axis of the points to its place, and those
/// before it to the front. Returns the axis. The range is not empty.
inline int split_at_median(std::span<uint32_t> range, std::span<const glm::dvec3> points) {
  Box box;
  for (const uint32_t index : range) box.extend(points[index]);
  const AlongAxis order{points, box.longest_axis()};
  std::nth_element(range.begin(), range.begin() + static_cast<std::ptrdiff_t>(range.size() / 2), range.end(),
                   order);
  return order.axis;
}

}  // namespace triptych
