// Where levels of detail may be enlarged to: about where they are, so that what is elsewhere does not matter.
#pragma once

#include "scene/box.hpp"

namespace triptych {

/// The box and all around it, by this share of its diagonal.
inline LatticeBox with_room(const LatticeBox& box, double share) {
  const int margin = static_cast<int>(glm::length(glm::dvec3(box.hi) - glm::dvec3(box.lo)) * share) + 1;
  return {box.lo - margin, box.hi + margin};
}

/// What two boxes share.
inline LatticeBox common(const LatticeBox& a, const LatticeBox& b) {
  return {glm::max(a.lo, b.lo), glm::min(a.hi, b.hi)};
}

}  // namespace triptych
