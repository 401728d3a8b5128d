// What contacts a model has, and what holding them costs.
#pragma once

#include <cstdint>

namespace triptych {

struct ContactReport {
  uint64_t contacts = 0;    ///< points of placed parts that touch others
  uint64_t held_parts = 0;  ///< parts with a chain of levels that holds points in contact
  /// Parts that have their free chain as well, for placements that touch nothing.
  uint64_t added_chains = 0;
  /// Placed parts that touch or overlap so many larger ones that not all contacts were looked for.
  uint64_t crowded_parts = 0;
};

}  // namespace triptych
