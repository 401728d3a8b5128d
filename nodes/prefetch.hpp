// Says which chunks will be needed soon, by where the camera goes.
#pragma once

#include "lod/cut.hpp"
#include "lod/hierarchy.hpp"
#include "residency/read_ahead.hpp"
#include "visibility/device.hpp"

#include <optional>

namespace triptych {

/// After each frame the camera is taken on its course, as it moved and turned since the frame before, or to
/// where it is known to go, and what it would see there is expected: other levels of what shows now
/// (LOD-switching events) before what comes into the frustum (visibility events), nearer things first. What
/// is in the frustum and hidden is not expected. Interactive Display 2003 §5, Quick-VDR 2004 §5.
class Prefetch {
 public:
  /// All must outlive it. bytes: of how much is expected at once, of the pack's.
  Prefetch(const Hierarchy& hierarchy, const Device& device, ReadAhead& residency, uint64_t bytes)
      : hierarchy_(hierarchy), device_(device), residency_(residency), bytes_(bytes) {}

  /// The frame was drawn, and showed this. next: the next one's view, if that is known.
  void drawn(const FrameView& view, const VisibleSet& visible, const View* next = nullptr);

 private:
  /// What is seen from there, at a priority of at least this.
  void expect(const FrameView& view, const View& then_view, float least, const VisibleSet& visible);
  bool shows_now(SceneNodeId node, const VisibleSet& visible) const;

  const Hierarchy& hierarchy_;
  const Device& device_;
  ReadAhead& residency_;
  uint64_t bytes_;
  std::optional<View> last_;
  CutLister lister_;
};

}  // namespace triptych
