// Chains of levels for parts that touch others.
#pragma once

#include "preprocess/parts.hpp"

#include <cstdint>
#include <vector>

namespace triptych {

struct ContactReport {
  uint64_t contacts = 0;    ///< pairs of a placed part's point and another placed part that it touches
  uint64_t held_parts = 0;  ///< parts with a chain of levels that holds points in contact
  uint64_t added_chains =
      0;  ///< of those, such whose free chain is used as well, where the part is placed alone
};

/// Gives the hierarchies their contacts, and parts the points that their levels must hold. A part that is
/// placed both in contact and alone gets a second chain (PartInfo::variant_of), so that one contact does not
/// freeze all its placements; all placements in contact share one, which holds what any of them does.
ContactReport hold_contacts(Parts& parts, std::vector<std::vector<Contact>> contacts,
                            const SpoolFile& geometry);

}  // namespace triptych
