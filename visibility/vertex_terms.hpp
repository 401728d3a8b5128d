// What the vertex stage of every device multiplies by: from a chunk's lattice to eye space, and on to clip
// space.
#pragma once

#include "base/epoch_marks.hpp"
#include "lod/frame_view.hpp"
#include "scene/sample_places.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

namespace triptych {

/// From lattice points to eye space (units: ClipSpace::unit): row · (point + cell, 1), the sum in integers.
struct PlacedLattice {
  glm::vec4 rows[3];
  glm::ivec3 cell;  ///< the eye's cell on the chunk's lattice, negated
};

/// Places the lattices of chunks under one frame view at a time. Positions are taken relative to the cell of
/// the eye (ClipSpace::reference) on the chunk's own lattice, in integers, so that precision does not depend
/// on where the model stands. Keeps its room from frame to frame.
class LatticePlacer {
 public:
  explicit LatticePlacer(const Skeleton& skeleton);

  void begin(const FrameView& view);
  /// transform, lattice: indices into Skeleton::transforms and Skeleton::lattices.
  PlacedLattice place(uint32_t transform, uint32_t lattice);

 private:
  PlacedLattice compute(uint32_t transform, uint32_t lattice) const;

  struct Known {
    uint32_t lattice = no_id;
    PlacedLattice placed;
  };
  const Skeleton& skeleton_;
  std::optional<FrameView> view_;
  EpochMarks is_known_;       ///< transforms
  std::vector<Known> known_;  ///< by transform, for the lattice that it was last asked with
};

/// From eye space (x, y, z) to clip space. Perspective: (frustum.x · x + frustum.z · z, frustum.y · y +
/// frustum.w · z, depth.x, −z). Orthographic: (frustum.x · x + frustum.z, frustum.y · y + frustum.w,
/// depth.x · z + depth.y, 1).
struct ClipTerms {
  glm::vec4 frustum;
  glm::vec2 depth;
};
/// Pixel centres lie at this sample of each pixel.
ClipTerms clip_terms(const FrameView& view, const SamplePlace& place = {});

}  // namespace triptych
