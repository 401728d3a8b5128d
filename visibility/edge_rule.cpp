#include "visibility/edge_rule.hpp"

namespace triptych {

EdgeRule::EdgeRule(const FrameView& view) {
  const Camera& camera = view.view().camera;
  const double width = camera.right - camera.left, height = camera.top - camera.bottom;
  rays_ = glm::vec4(width / view.view().width, height / view.view().height, camera.left, camera.bottom);
  const bool orthographic = view.clip.orthographic;
  depth_scale_ = orthographic ? static_cast<float>(1 / view.clip.range) : 0;
  tolerance_ = static_cast<float>(double{step_pixels} / view.focal_length);
  if (orthographic) tolerance_ *= depth_scale_;
}

}  // namespace triptych
