// What contacts a model has, and what holding them costs.
#pragma once

#include <cstdint>

namespace triptych {

struct ContactReport {
  uint64_t contacts = 0;    ///< pairs of a placed part's point and another placed part that it touches
  uint64_t held_parts = 0;  ///< parts with a chain of levels that holds points in contact
  uint64_t added_chains =
      0;  ///< of those, such whose free chain is used as well, where the part is placed alone
};

}  // namespace triptych
