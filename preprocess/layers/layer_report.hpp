// What surfaces of a model lie on each other in one plane.
#pragma once

#include <cstdint>

namespace triptych {

struct LayerReport {
  uint64_t facets = 0;         ///< flat faces that others lie on
  uint64_t triangles = 0;      ///< of them, in parts
  uint32_t most = 0;           ///< layers in one plane
  uint64_t crowded_parts = 0;  ///< placed parts that overlap so many others that not all were looked at
};

}  // namespace triptych
