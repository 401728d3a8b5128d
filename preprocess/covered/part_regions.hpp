// The smooth regions of a part: connected triangles of one colour, without a sharp edge between them.
#pragma once

#include "preprocess/part.hpp"
#include "scene/lattice.hpp"
#include "simplify/box_tree.hpp"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace triptych {

struct SmoothRegion {
  Box box;
  uint32_t first = 0, count = 0;  ///< in PartRegions::triangles
  bool is_cut = false;            ///< it reaches the part's border, and may go on beyond it
};

/// All in the space of the part's lattice.
struct PartRegions {
  PartRegions(const Part& part, const Lattice& lattice);

  std::vector<glm::dvec3> points;                  ///< the part's
  std::vector<std::array<uint32_t, 3>> triangles;  ///< by region
  std::vector<uint32_t> numbers;                   ///< of each of them, in the part
  std::vector<uint32_t> region_of;                 ///< of each of them
  std::vector<SmoothRegion> regions;
  BoxTree tree;         ///< of the triangles' boxes
  double diagonal = 0;  ///< of the part's box

  /// Of all of this in memory, roughly; bytes.
  size_t size() const { return points.size() * 24 + triangles.size() * 150 + regions.size() * 60; }
};

}  // namespace triptych
