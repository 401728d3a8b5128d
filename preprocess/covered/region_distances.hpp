// How far what is covered lies from what is not: from which error on levels of detail leave it out.
#pragma once

#include "preprocess/covered/find_covered.hpp"

#include <cstdint>
#include <map>
#include <vector>

namespace triptych {

/// The covered regions of a placed part, and what covers each.
using CoveredPart = std::map<uint32_t, std::vector<RegionCover>>;
using CoveredParts = std::map<uint32_t, CoveredPart>;  // by placed part

/// The classes of distances (error_gaps.hpp) of a part's covered regions, by region; of those alone that are
/// near enough to be left out.
using RegionClasses = std::map<uint32_t, uint32_t>;

/// By part. A region's distance is a bound of how far it is, in any of the placements, from what is not
/// covered: of the part itself, of what covers it, and of what covers that. kept: what earlier builds found.
std::map<uint32_t, RegionClasses> region_classes(const Parts& parts, const PlacedParts& hierarchy,
                                                 const CoveredParts& covered, PartCache<PartRegions>& cache,
                                                 const PlacedCache& kept);

}  // namespace triptych
