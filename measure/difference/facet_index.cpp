#include "measure/difference/facet_index.hpp"

#include "base/hashing.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace triptych {

namespace {

glm::dvec3 centre_of(const PlacedShape::Facet& facet) {
  return (facet.corners[0] + facet.corners[1] + facet.corners[2]) / 3.0;
}

constexpr std::array<std::array<size_t, 3>, 6> orders = {
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};

FacetMatch compare(const PlacedShape::Facet& a, const PlacedShape::Facet& b, double tolerance) {
  FacetMatch best = FacetMatch::none;
  for (const auto& order : orders) {
    bool near = true, same_colors = true;
    for (size_t k = 0; near && k < 3; ++k) {
      const glm::dvec3 off = glm::abs(a.corners[k] - b.corners[order[k]]);
      near = std::max({off.x, off.y, off.z}) <= tolerance;
      same_colors = same_colors && a.colors[k] == b.colors[order[k]];
    }
    if (near) best = std::max(best, same_colors ? FacetMatch::shape_and_colors : FacetMatch::shape);
  }
  return best;
}

}  // namespace

FacetIndex::FacetIndex(const PlacedShape& shape, double furthest)
    : shape_(shape), cell_size_(std::max(4 * furthest, 1e-300)) {
  for (uint32_t i = 0; i < shape.facets.size(); ++i)
    facets_.emplace_back(cell_of(glm::floor(centre_of(shape.facets[i]) / cell_size_)), i);
  std::sort(facets_.begin(), facets_.end());
}

uint64_t FacetIndex::cell_of(const glm::dvec3& place) const {
  const std::array<double, 3> cell = {place.x + 0.0, place.y + 0.0, place.z + 0.0};  // no negative zeros
  return hash_values(std::span<const double>(cell));
}

FacetMatch FacetIndex::find_in(uint64_t cell, const PlacedShape::Facet& facet, double tolerance) const {
  FacetMatch best = FacetMatch::none;
  const std::pair first(cell, uint32_t{0});
  for (auto at = std::lower_bound(facets_.begin(), facets_.end(), first);
       at != facets_.end() && at->first == cell && best != FacetMatch::shape_and_colors; ++at)
    best = std::max(best, compare(facet, shape_.facets[at->second], tolerance));
  return best;
}

FacetMatch FacetIndex::find(const PlacedShape::Facet& facet, double tolerance) const {
  const glm::dvec3 centre = centre_of(facet);
  const glm::dvec3 low = glm::floor((centre - tolerance) / cell_size_);
  const glm::dvec3 high = glm::floor((centre + tolerance) / cell_size_);
  FacetMatch best = FacetMatch::none;
  for (int corner = 0; corner < 8 && best != FacetMatch::shape_and_colors; ++corner) {
    glm::dvec3 cell = low;
    bool is_new = true;  // where low and high are the same cell, it is looked at once
    for (int axis = 0; axis < 3; ++axis) {
      if ((corner >> axis & 1) == 0) continue;
      is_new = is_new && high[axis] != low[axis];
      cell[axis] = high[axis];
    }
    if (is_new) best = std::max(best, find_in(cell_of(cell), facet, tolerance));
  }
  return best;
}

}  // namespace triptych
