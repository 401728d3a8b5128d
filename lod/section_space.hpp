// Where boxes lie in a section, for one view.
#pragma once

#include "lod/clip_space.hpp"
#include "scene/frame_state.hpp"

#include <cstdint>
#include <glm/vec3.hpp>

namespace triptych {

/// Where a box lies in a section, as far as drawing needs it: a function of frame view and box.
struct SectionPlace {
  bool outside = false;  ///< beyond a side by more than rounding can bring back: nothing of it is kept
  uint32_t cut = 0;      ///< a bit for each of SectionSides::all() beyond which some of it may be
  /// Certainly all kept.
  bool inside() const { return cut == 0; }
};

/// A frame state's section with the margins of its view: computed once a frame.
///
/// Fragments are kept up to `tolerance()` beyond a side, so that a face which lies in a side is there as a
/// whole, and not in speckles: by what rounding in the vertex stage, as a rule, and snapping to a 128th of a
/// pixel may move it. Perspective: as a share of the depth; orthographic: in model units.
class SectionSpace {
 public:
  SectionSpace(const FrameState& state, const ClipSpace& clip, double focal_length);

  bool keeps_all() const { return sides_.all().empty(); }
  const SectionSides& sides() const { return sides_; }
  double tolerance() const { return tolerance_; }
  /// box: model space. rounding: EyeSpace::rounding() of it.
  SectionPlace place(const Box& box, double rounding) const;

 private:
  SectionSides sides_;
  glm::dvec3 eye_;
  double tolerance_;
  bool orthographic_;
};

}  // namespace triptych
