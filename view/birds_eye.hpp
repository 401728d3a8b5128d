// What culling does, seen from above: what was drawn, the frustum, and the boxes of visible and culled scene
// nodes.
#pragma once

#include "lod/cut.hpp"
#include "render/line_pass.hpp"
#include "render/renderer.hpp"
#include "visibility/visible_set.hpp"

#include <optional>

namespace triptych {

/// A camera straight above the view's eye whose line of sight points up on the screen. It covers nine of ten
/// of the cut's boxes by their centres: the ground reaches too far to be a measure. It starts a little above
/// the eye's height, so that ceilings do not hide rooms. Same viewport; deterministic.
View birds_eye_view(const Skeleton& skeleton, const View& view, const std::vector<DrawableId>& cut);

class BirdsEye {
 public:
  explicit BirdsEye(Renderer& renderer) : renderer_(renderer) {}

  /// Draws V(i) and over it the view's frustum (yellow) and the boxes of cut i: green where the drawable is
  /// visible, red where it was culled.
  const Target& draw(const View& view, const Cut& cut, const VisibleSet& visible);

 private:
  Renderer& renderer_;
  LinePass lines_;
  std::optional<Target> target_;
};

}  // namespace triptych
