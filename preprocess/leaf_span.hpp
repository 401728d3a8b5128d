// Which leaves of a hierarchy have to do with a point.
#pragma once

#include <cstdint>

namespace triptych {

/// Places of the leaves that a held point belongs to, or that touch it: the first and the last; empty for a
/// point that may move at once.
struct LeafSpan {
  uint32_t first = 0xffffffffu, last = 0;
  float reach =
      0;  ///< lattice steps over which the largest of its contacts extends; infinite for a border point
  void extend(const LeafSpan& other) {
    reach = reach > other.reach ? reach : other.reach;
    first = first < other.first ? first : other.first;
    last = last > other.last ? last : other.last;
  }
};

}  // namespace triptych
