// The final objects: placed parts, clustered and partitioned again; each becomes a leaf of the hierarchy.
#pragma once

#include "lod/build.hpp"
#include "lod/parts.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

struct Objects {
  std::vector<std::vector<uint32_t>> members;  ///< of each object the indices of its placed parts, ascending
  std::vector<Box> boxes;                      ///< of each object, model space
  ObjectCounts counts;
};

/// `boxes`: of each placed part, on the model's lattice. Only parts that are small, by triangles and by
/// extent, are grouped; a wall or a slab stays an object of its own, with a box as tight as it is.
Objects make_objects(const Parts& parts, std::span<const LatticeBox> boxes, const BuildOptions& options);

}  // namespace triptych
