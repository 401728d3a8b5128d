// Which cells one frame's camera sees, through which part of the screen (berkeley-walkthrough-1996 §3.3).
#pragma once

#include "base/epoch_marks.hpp"
#include "cells/cell_graph.hpp"
#include "visibility/screen_bounds.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace triptych {

/// Walks from the eye's cell through portals, each of which narrows the part of the screen that what lies
/// behind it can show in. What levels of detail may move and the device's rules may round is allowed for:
/// walls deviate by the pixel error. Reuses its memory from frame to frame. The graph
/// must outlive it. For one thread.
class PortalView {
 public:
  explicit PortalView(const CellGraph& graph);

  /// A perspective view in which nothing is hidden or cut away: then what is drawn closes what walls close.
  static bool applies_to(const FrameView& view);
  /// view: one that it applies to.
  void begin(const FrameView& view);
  /// Whether anything in the box may be seen.
  bool may_see(const LatticeBox& box);
  /// Cells that are seen in this frame.
  size_t seen_cells() const { return seen_count_; }

 private:
  /// A part of the screen, in normalised device coordinates.
  struct ScreenPart {
    float left = -1, bottom = -1, right = 1, top = 1;
    bool empty() const { return left > right || bottom > top; }
  };
  static ScreenPart common(const ScreenPart& a, const ScreenPart& b);
  Box grown_by_pixels(const Box& box, double pixels, double more) const;
  std::optional<ScreenPart> on_screen(const Box& box) const;
  static bool holds(const ScreenPart& a, const ScreenPart& b);
  void enter(uint32_t cell, const ScreenPart& part);
  void look_out_of(uint32_t cell, const ScreenPart& part);
  bool is_before(const Portal& portal) const;
  void look_in_from_outside();

  const CellGraph& graph_;
  std::optional<FrameView> view_;
  std::optional<BoxProjector> projector_;
  glm::dvec3 eye_{0};
  double near_reach_ = 0;  ///< how far the corners of the near plane are from the eye
  double pixel_ = 0;       ///< width or height of a pixel at unit distance, whichever is more
  EpochMarks seen_;
  std::vector<std::vector<ScreenPart>> parts_;  ///< of cells that are seen
  std::vector<std::pair<uint32_t, ScreenPart>> waiting_;
  std::vector<uint32_t> open_;
  size_t seen_count_ = 0;
};

}  // namespace triptych
