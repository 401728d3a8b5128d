// Points that lie within a closed body that the surface around them comes out of: the backs of windows in a
// wall.
#pragma once

#include "simplify/surface.hpp"

#include <cstdint>
#include <vector>

namespace triptych {

/// For each point whether an edge leads from it out through the front of a closed component of the surface,
/// another one than its own, and none into one; or whether it is a corner of a covered triangle. Empty if
/// there is none. What shows must not go there for nothing: it would be hidden, or come out beside what hides
/// it.
std::vector<uint8_t> sunk_points(const Surface& surface);

}  // namespace triptych
