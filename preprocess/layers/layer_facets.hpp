// Which of the flat faces in one plane lies on which.
#pragma once

#include "preprocess/layers/find_layers.hpp"
#include "preprocess/layers/layer_report.hpp"

#include <vector>

namespace triptych {

/// For each facet in an overlap how many layers lie on it: one more than on any that lies on it, at most
/// max_layers_above.
struct LayeredFacet {
  uint32_t part = 0, facet = 0, layers = 0;
};

/// By part and facet. What is placed on what: an instance that spans less of the plane lies on one that spans
/// more, of one instance's facets the smaller one on the larger one, and of equal ones that which comes later
/// in the file. This is one order of all facets, so there are no cycles.
std::vector<LayeredFacet> layer_facets(const std::vector<FacetOverlap>& overlaps);

/// Finds the layers of all hierarchies, and gives them to the parts (PartInfo::layers). `memory`: bytes that
/// geometry may take at a time, roughly.
LayerReport make_layers(Parts& parts, const SpoolFile& geometry, uint64_t memory);

}  // namespace triptych
