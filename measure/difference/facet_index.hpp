// The triangles of a shape by where they are.
#pragma once

#include "measure/difference/object_shapes.hpp"

#include <cstdint>
#include <utility>
#include <vector>

namespace triptych {

enum class FacetMatch : uint8_t { none, shape, shape_and_colors };

class FacetIndex {
 public:
  /// Finds triangles whose corners are off by no more than `furthest`, model units. The shape must outlive
  /// it.
  FacetIndex(const PlacedShape& shape, double furthest);

  /// Whether the shape has the triangle, with corners off by at most `tolerance` on each axis and in whatever
  /// order; the tolerance is at most `furthest`.
  FacetMatch find(const PlacedShape::Facet& facet, double tolerance) const;

 private:
  uint64_t cell_of(const glm::dvec3& place) const;
  FacetMatch find_in(uint64_t cell, const PlacedShape::Facet& facet, double tolerance) const;

  const PlacedShape& shape_;
  double cell_size_;
  std::vector<std::pair<uint64_t, uint32_t>>
      facets_;  ///< hash of the cell of its centre, and index; ascending
};

}  // namespace triptych
