// Which of the flat faces in one plane lies on which.
#pragma once

#include "preprocess/layers/find_layers.hpp"
#include "preprocess/layers/layer_report.hpp"

#include <vector>

namespace triptych {

/// A facet in an overlap, and its layer (scene/layers.hpp): one more than that of any that lies on it.
struct LayeredFacet {
  uint32_t part = 0, facet = 0, layer = 0;
};

/// By part and facet. What is placed on what: an instance that spans far less of the plane (by a factor of 8,
/// roughly) lies on one that spans more, of one instance's facets a far smaller one on a larger one, and of
/// those of about one size that which comes later in the file. This is one order of all facets, so there are
/// no cycles.
std::vector<LayeredFacet> layer_facets(const std::vector<FacetOverlap>& overlaps);

/// Finds the layers of all hierarchies, and gives them to the parts (PartInfo::layers). `memory`: bytes that
/// geometry may take at a time, roughly. kept: what earlier builds found.
LayerReport make_layers(Parts& parts, const SpoolFile& geometry, uint64_t memory, const PlacedCache& kept);

}  // namespace triptych
