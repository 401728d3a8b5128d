// Boxes in an order in which those near each other come one after the other.
#pragma once

#include "scene/box.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// The indices of the boxes along a Z curve through their middles (Morton, A computer oriented geodetic data
/// base, 1966): what works on one after the other meets the same surroundings again.
std::vector<uint32_t> spatial_order(std::span<const Box> boxes);

}  // namespace triptych
