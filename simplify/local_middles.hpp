// Where the middle of a long thing is, place by place.
#pragma once

#include "simplify/component_covers.hpp"
#include "simplify/key_hash.hpp"

#include <cstdint>
#include <tsl/robin_map.h>
#include <vector>

namespace triptych {

class LocalMiddles {
 public:
  /// Both are kept by reference.
  LocalMiddles(const Surface& surface, const ComponentCovers& components)
      : surface_(surface), components_(components), has_cells_(components.covers.size(), 0) {}

  /// The mean of the points of the same component around one of them, so that a cross section is within
  /// reach: for a wire a point of its axis. Where there is none, the middle of it and of the nearest one, if
  /// both seem to be the end of something long; otherwise the point itself.
  glm::dvec3 around(uint32_t point);

 private:
  using CellKey = std::array<uint32_t, 4>;  ///< component, cell
  double reach(uint32_t component) const;
  CellKey cell_of(uint32_t component, const glm::dvec3& point) const;
  void fill_cells(uint32_t component);
  glm::dvec3 middle_of_two(uint32_t component, const glm::dvec3& place) const;

  const Surface& surface_;
  const ComponentCovers& components_;
  std::vector<uint8_t> has_cells_;             ///< for each component
  std::vector<std::vector<uint32_t>> points_;  ///< of each component; made at the first call
  tsl::robin_map<CellKey, std::vector<uint32_t>, KeyHash, KeyEqual> cells_;
};

}  // namespace triptych
