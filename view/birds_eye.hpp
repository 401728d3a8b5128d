// What culling does, seen from above: what was drawn, the frustum, and the boxes of visible and culled scene
// nodes.
#pragma once

#include "lod/cut.hpp"
#include "visibility/device.hpp"
#include "visibility/visible_set.hpp"

#include <memory>

namespace triptych {

/// A camera straight above the view's eye whose line of sight points up on the screen. It covers nine of ten
/// of the cut's boxes, by their centres: large boxes such as the ground would make the picture too small. It
/// starts a little above the eye's height, so that ceilings do not hide rooms. Same viewport; deterministic.
View birds_eye_view(const Skeleton& skeleton, const View& view, const std::vector<DrawableId>& cut);

class BirdsEye {
 public:
  BirdsEye(const Skeleton& skeleton, Device& device) : skeleton_(skeleton), device_(device) {}

  /// Draws V(i) and over it the view's frustum (yellow) and the boxes of cut i: green where the drawable is
  /// visible, red where it was culled. Good until the next call.
  const FrameTarget& draw(const FrameView& view, const VisibleSet& visible);

 private:
  const Skeleton& skeleton_;
  Device& device_;
  std::unique_ptr<FrameTarget> target_;
};

}  // namespace triptych
