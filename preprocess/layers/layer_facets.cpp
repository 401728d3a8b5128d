#include "preprocess/layers/layer_facets.hpp"

#include "scene/layers.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace triptych {

namespace {

using Name = std::pair<uint32_t, uint32_t>;  ///< part and facet

/// Areas in steps of a factor of 8: within one of them the order of the file says more.
int size_class(double area) {
  int exponent = 0;
  std::frexp(area, &exponent);
  return exponent >= 0 ? exponent / 3 : -((2 - exponent) / 3);
}

/// What the order of layers is made of, over all placements of a facet.
struct Extent {
  double span = 0, area = 0;
  uint32_t instance = 0;
};

}  // namespace

std::vector<LayeredFacet> layer_facets(const std::vector<FacetOverlap>& overlaps) {
  std::map<Name, Extent> extents;
  for (const FacetOverlap& overlap : overlaps) {
    for (const PlacedFacet* of : {&overlap.a, &overlap.b}) {
      const auto [found, inserted] =
          extents.try_emplace({of->part, of->facet}, Extent{of->span, of->area, of->instance});
      if (inserted) continue;
      found->second.span = std::min(found->second.span, of->span);
      found->second.instance = std::min(found->second.instance, of->instance);
    }
  }
  // The uppermost first.
  const auto key = [&](const std::pair<const Name, Extent>& entry) {
    const auto& [name, extent] = entry;
    return std::tuple(size_class(extent.span), size_class(extent.area), -int64_t{extent.instance},
                      -int64_t{name.first}, -int64_t{name.second});
  };
  std::vector<const std::pair<const Name, Extent>*> order;
  for (const auto& entry : extents) order.push_back(&entry);
  std::sort(order.begin(), order.end(), [&](const auto* a, const auto* b) { return key(*a) < key(*b); });
  std::map<Name, uint32_t> places;
  for (uint32_t place = 0; place < order.size(); ++place) places[order[place]->first] = place;
  std::vector<std::vector<uint32_t>> above(order.size());  // by place
  for (const FacetOverlap& overlap : overlaps) {
    const uint32_t a = places[{overlap.a.part, overlap.a.facet}],
                   b = places[{overlap.b.part, overlap.b.facet}];
    above[std::max(a, b)].push_back(std::min(a, b));
  }
  std::vector<uint32_t> layers(order.size(), 1);
  for (uint32_t place = 0; place < order.size(); ++place) {
    for (const uint32_t other : above[place])
      layers[place] = std::max(layers[place], std::min(layers[other] + 1, max_layer));
  }
  std::vector<LayeredFacet> result;
  for (const auto& [name, place] : places) result.push_back({name.first, name.second, layers[place]});
  return result;
}

namespace {

/// The triangles of a part's facets.
struct FacetTriangles {
  std::vector<uint32_t> ends;     ///< of each facet in `numbers`; they come one after the other
  std::vector<uint32_t> numbers;  ///< in the part
};

}  // namespace

template <>
inline constexpr auto record_members<FacetTriangles> = std::tuple(&FacetTriangles::ends,
                                                                  &FacetTriangles::numbers);

LayerReport make_layers(Parts& parts, const SpoolFile& geometry, uint64_t memory, const PlacedCache& kept) {
  LayerReport report;
  PartCache<PartFacets> cache(parts, geometry, memory);
  std::vector<FacetOverlap> overlaps;
  for (const PlacedParts& hierarchy : parts.hierarchies) {
    const auto found = find_layers(parts, hierarchy, cache, kept, report.crowded_parts);
    overlaps.insert(overlaps.end(), found.begin(), found.end());
  }
  const auto triangles_of = [&](uint32_t part) {
    constexpr std::string_view what = "facets";
    ContentKeyWriter key;
    if (kept.is_used()) {
      kept.begin(key, what, parts.hierarchies.back());
      kept.add_part(key, part);
    }
    return kept.get<FacetTriangles>(what, key, [&] {
      const auto facets = cache.get(part);
      FacetTriangles triangles{{}, facets->numbers};
      for (const Facet& facet : facets->facets) triangles.ends.push_back(facet.first + facet.count);
      return triangles;
    });
  };
  FacetTriangles facets;
  uint32_t part = no_id;  // that they are of
  for (const LayeredFacet& layered : layer_facets(overlaps)) {
    if (layered.part != std::exchange(part, layered.part)) facets = triangles_of(part);
    const uint32_t first = layered.facet == 0 ? 0 : facets.ends.at(layered.facet - 1);
    const uint32_t end = facets.ends.at(layered.facet);
    std::vector<LayeredTriangle>& own = parts.parts[layered.part].layers;
    for (uint32_t i = first; i < end; ++i) own.push_back({facets.numbers.at(i), layered.layer});
    if (layered.layer == 1) continue;
    ++report.facets;
    report.triangles += end - first;
    report.most = std::max(report.most, layered.layer);
  }
  for (PartInfo& info : parts.parts) {
    std::sort(info.layers.begin(), info.layers.end(),
              [](const LayeredTriangle& a, const LayeredTriangle& b) { return a.triangle < b.triangle; });
  }
  return report;
}

}  // namespace triptych
