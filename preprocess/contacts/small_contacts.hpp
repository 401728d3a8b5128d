// Contacts that are too small to matter at a level of detail.
#pragma once

#include "preprocess/hlod.hpp"

#include <cstdint>
#include <vector>

namespace triptych {

/// Frees points from `locked`, one flag for each point of the surface, whose contacts are so small that a gap
/// there is no larger than what the level may be off anyway. Locked points hang together where they are about
/// as near as `distance` (lattice steps), or nearer; a group is small if neither it nor any of its contacts
/// (LeafSpan::reach) extends over more than twice the distance. So the end of a pipe is freed before the pipe
/// vanishes, and a long seam of small tiles is not.
void free_small_contacts(const Baked& baked, double distance, std::vector<uint8_t>& locked);

}  // namespace triptych
