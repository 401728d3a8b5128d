// Which surfaces lie right beneath others, so that nobody outside sees them.
#pragma once

#include "preprocess/covered/part_regions.hpp"
#include "preprocess/covered/surroundings.hpp"
#include "preprocess/part_cache.hpp"
#include "preprocess/parts.hpp"
#include "preprocess/placed_cache.hpp"

#include <cstdint>
#include <vector>

namespace triptych {

/// A region of a placed part that is covered.
struct CoveredRegion {
  uint32_t placed = 0;              ///< index into PlacedParts::placed
  uint32_t region = 0;              ///< index into its PartRegions::regions
  std::vector<RegionCover> covers;  ///< what lies over it, by placed part, ascending
};

/// The covered regions of a hierarchy's placed parts, by part. Samples all over a region look out
/// along its normals: it is covered if each of them meets another surface within 1/16 of the region's
/// diagonal, or lies inside a body that it leaves within the diagonal; the corner of one that a part's border
/// cut off may lie deeper, but must be hidden from the sides. Only regions of meshes that enclose bodies,
/// whose backs nobody sees. A part's region counts if it is covered in each of its placements. kept: what
/// earlier builds found.
std::vector<CoveredRegion> find_covered(const Parts& parts, const PlacedParts& hierarchy,
                                        PartCache<PartRegions>& regions, const PlacedCache& kept);

}  // namespace triptych
