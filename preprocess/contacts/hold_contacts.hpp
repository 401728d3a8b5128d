// Chains of levels for parts that touch others.
#pragma once

#include "preprocess/contacts/contact_report.hpp"
#include "preprocess/contacts/find_contacts.hpp"
#include "preprocess/parts.hpp"

#include <cstdint>
#include <vector>

namespace triptych {

/// Gives the hierarchies their contacts, and parts the points that their levels must hold. A part that is
/// placed both in contact and alone gets a second chain (PartInfo::variant_of), so that one contact does not
/// freeze all its placements; all placements in contact share one, which holds what any of them does.
ContactReport hold_contacts(Parts& parts, std::vector<FoundContacts> contacts, const SpoolFile& geometry);

}  // namespace triptych
