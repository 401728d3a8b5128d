// Where flat faces of different colours lie on each other in one plane.
#pragma once

#include "preprocess/layers/part_facets.hpp"
#include "preprocess/part_cache.hpp"
#include "preprocess/parts.hpp"
#include "preprocess/placed_cache.hpp"

#include <cstdint>
#include <vector>

namespace triptych {

/// A facet of a part, in one of its placements.
struct PlacedFacet {
  uint32_t part = 0, facet = 0;  ///< index into Parts::parts, and into its PartFacets::facets
  uint32_t instance = 0;         ///< PlacedPart::instance
  /// The area of all of the instance's facets in its plane; infinite for one of more than 64 parts.
  double span = 0;
  double area = 0;  ///< its own
};

struct FacetOverlap {
  PlacedFacet a, b;
};

/// The overlaps between the placed parts of a hierarchy, and within each of them, in an order that depends on
/// the model alone. Two facets overlap where they lie in one plane, within contact_steps, and their triangles
/// overlap there by more than that. Those that show their fronts to each other's backs, as bodies do that
/// touch, are none: neither is seen. `crowded`: placed parts whose boxes overlap more than 1,024 larger ones,
/// the others of which were not looked at, are added. kept: what earlier builds found.
std::vector<FacetOverlap> find_layers(const Parts& parts, const PlacedParts& hierarchy,
                                      PartCache<PartFacets>& facets, const PlacedCache& kept,
                                      uint64_t& crowded);

}  // namespace triptych
