// Levels of detail that cover as much of the screen as what they stand for: small things must not thin out as
// they get simpler.
#pragma once

#include "base/disjoint_sets.hpp"
#include "simplify/surface.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// A connected component of a surface, as something that covers a part of the screen.
struct Cover {
  /// On average over all directions, from afar, square lattice steps: a quarter of the area of what is closed
  /// (Cauchy), half of what is flat, in between by how much its normals cancel. What hides itself otherwise
  /// is not counted.
  double covered = 0;
  double area = 0, flatness = 0;  ///< flatness: 0 where normals cancel, 1 where all are the same
  glm::dvec3 middle{0};           ///< of its area
  double radius = 0;              ///< no point is further from the middle
  uint32_t material = 0;          ///< of its largest triangle
  bool locked = false;            ///< whether one of its points is
};

class CoverKeeper {
 public:
  /// `locked`: for each point of the source whether it must stay where it is; empty: none. Kept by reference.
  CoverKeeper(const Surface& source, std::span<const uint8_t> locked);

  /// Enlarges components of a level of the source, about their middles, to the cover of the components whose
  /// points they hold; and where components have vanished, small ones of the same material take over theirs
  /// (Cook, Halstead, Planck and Ryu, Stochastic simplification of aggregate detail, 2007). Components with
  /// locked points stay, and so do those that are large against the level's bound, which lose little. No
  /// point moves further than half of the bound, or out of the source's box. Returns how far the furthest
  /// did, lattice steps.
  double restore(Piece& level, double bound) const;

 private:
  const Surface& source_;
  std::span<const uint8_t> locked_;
  std::vector<uint32_t> component_of_;  ///< for each point
  std::vector<Cover> covers_;           ///< of the components
};

}  // namespace triptych
