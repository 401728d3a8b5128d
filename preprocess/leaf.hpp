// LODs of the parts, shared by all placements, and the drawables of the leaves that are made of them.
#pragma once

#include "preprocess/parts.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// A part at one level of detail, as it is in the pack.
struct PartLevel {
  uint32_t chunk = 0, triangles = 0;
  double bound = 0;  ///< of the distance to the mesh, mesh units, rounding to the lattice included
  double grown = 0;  ///< how far it may reach beyond the box of the part, mesh units
};

struct PartLevels {
  std::vector<PartLevel> levels;  ///< finest first: the part itself
  /// For each level where its geometry lies (a Part), if HLODs may begin with it; of size 0 otherwise. A
  /// border point's number is its index among the part's own border points.
  std::vector<SpoolPlace> surfaces;
};

/// Simplifies every part, one unit per part, and adds its levels to the pack. The geometry of the coarsest
/// level of each part, and of levels with at most `kept_triangles`, is kept for HLODs.
std::vector<PartLevels> make_part_levels(const Parts& parts, const BuildOptions& options,
                                         size_t kept_triangles, BuildWork& work, ImportReport& report);

/// A drawable that is not in the skeleton yet.
struct LeafDrawable {
  double error = 0;
  uint64_t triangles = 0;
  std::vector<uint32_t> levels;  ///< for each member which of its part's levels
};

/// The drawables of a leaf with these members (indices of placed parts), finest first: each next one has
/// twice the error or more, every member at its coarsest level within it, and at most 70 % of the triangles.
/// They end with the first that has at most `exit_triangles`: coarser ones are left to the HLODs above, which
/// start from the last one.
std::vector<LeafDrawable> leaf_drawables(const PlacedParts& parts, std::span<const PartLevels> levels,
                                         std::span<const uint32_t> members, size_t exit_triangles);

}  // namespace triptych
