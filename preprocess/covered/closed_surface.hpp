// Whether a surface encloses bodies.
#pragma once

#include "simplify/surface.hpp"

#include <cstdint>

namespace triptych {

/// Which sides of closed surfaces look out.
enum class Outside : uint8_t {
  none,   ///< it is not closed, or not the same side of all of it
  front,  ///< seen from outside, triangles go round counter-clockwise
  back,
};

/// Closed is a surface whose edges are passed as often one way as the other by its triangles. Each connected
/// piece of it has to go round its body the same way. Whether it meets itself is not looked at.
Outside outside_of(const Surface& surface);

}  // namespace triptych
