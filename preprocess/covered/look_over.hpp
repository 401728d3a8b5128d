// What covers a region of a placed part, by samples all over it.
#pragma once

#include "preprocess/covered/surroundings.hpp"

#include <optional>
#include <vector>

namespace triptych {

/// Of what stands around the placed part in the middle what look_over() may meet, and itself; in the order in
/// which it was given. So what the others are does not matter to it. tolerance: up to it surfaces touch.
std::vector<uint32_t> reached_from(Surroundings& surroundings, uint32_t region, double tolerance);

/// What covers a region of the placed part in the middle, and how near it comes, ascending; nothing where it
/// is not covered all over, or too small to tell.
std::optional<std::vector<RegionCover>> look_over(Surroundings& surroundings, uint32_t region,
                                                  double tolerance);

}  // namespace triptych
