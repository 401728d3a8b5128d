// Measures how far the drawables along a path really are from their source, instead of trusting their bounds.
#pragma once

#include "base/distribution.hpp"
#include "nodes/frame_record.hpp"
#include "scene/frame_state.hpp"
#include "scene/pack.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

struct PathDeviation {
  /// The largest over frames and drawables of the cuts: the drawable's measured two-sided distance to its
  /// source, projected in that view as its bound is (projected_error). Unbounded distances are the largest
  /// number.
  double pixels_max = 0;
  DrawableId drawable = no_id;        ///< the drawable; no_id if all drawables are source
  uint32_t frame = 0;                 ///< the frame
  uint64_t drawables = 0;             ///< in any of the cuts
  uint64_t drawables_simplified = 0;  ///< of those: not the source itself. Each of them is measured.
  /// Bound over measured distance, of the simplified ones whose distance exceeds the lattice's rounding.
  Distribution bound_over_measured;
};

/// One for each list of frames. No drawable is left out; distances are measured once for all lists, at about
/// `points` points over all drawables (measured_distances), so the results are lower bounds of the true
/// values. Error for a chunk that is damaged.
std::vector<PathDeviation> measure_deviation(const Pack& pack,
                                             std::span<const std::vector<FrameRequest>> paths,
                                             uint64_t points);

}  // namespace triptych
