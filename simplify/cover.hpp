// Levels of detail that cover as much of the screen as what they stand for: small things must not thin out as
// they get simpler.
#pragma once

#include "simplify/component_covers.hpp"
#include "simplify/layered_planes.hpp"
#include "simplify/local_middles.hpp"
#include "simplify/surface.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

class CoverKeeper {
 public:
  /// `locked`: for each point of the source whether it must stay where it is; empty: none. `planes`: of the
  /// source, which its points do not leave. All are kept by reference.
  CoverKeeper(const Surface& source, std::span<const uint8_t> locked,
              const LayeredPlanes& planes = LayeredPlanes::none())
      : locked_(locked), planes_(planes), source_(source), middles_(source, source_) {}
  CoverKeeper(const CoverKeeper&) = delete;
  CoverKeeper& operator=(const CoverKeeper&) = delete;

  /// Enlarges components of a level of the source to the cover of the components whose points they hold,
  /// about their middles, or, where they are long, across; and where components have vanished, small ones of
  /// the same material take over theirs (Cook, Halstead, Planck and Ryu, Stochastic simplification of
  /// aggregate detail, 2007). Locked points stay, and so do components that are thick against the level's
  /// bound, which lose little. No point moves further than half of the bound, or the whole of it in what is
  /// small. share: of that cover. Returns how far the furthest did, lattice steps.
  double restore(Piece& level, double bound, double share = 1);

 private:
  class Growth;
  double set_ways(Growth& growth, const Piece& level, const Cover& cover, std::span<const uint32_t> points,
                  std::span<const uint32_t> triangles, double goal, double bound);
  bool keep_sides(Growth& growth, const Piece& level, std::span<const uint32_t> points, double most) const;
  double enlarge(Growth& growth, const Piece& level, const Cover& cover, std::span<const uint32_t> points,
                 std::span<const uint32_t> triangles, double goal, double bound);
  glm::dvec3 middle_of(const Piece& level, std::span<const uint32_t> points) const;
  const Cover& of_source(const Piece& level, uint32_t point) const {
    return source_.covers[source_.component_of[level.sources[point]]];
  }
  std::vector<double> goals(const Piece& level, const ComponentCovers& of_level, double bound) const;
  bool is_locked(const Piece& level, uint32_t point) const {
    return !locked_.empty() && locked_[level.sources[point]] != 0;
  }

  std::span<const uint8_t> locked_;
  const LayeredPlanes& planes_;
  ComponentCovers source_;
  LocalMiddles middles_;  ///< of the source
};

}  // namespace triptych
