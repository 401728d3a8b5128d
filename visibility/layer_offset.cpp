#include "visibility/layer_offset.hpp"

#include <glm/geometric.hpp>

namespace triptych {

LayerOffset::LayerOffset(const FrameView& view, double rest) {
  const View& of = view.view();
  const ClipSpace& clip = view.clip;
  focal_x = static_cast<float>(of.focal_x());
  focal_y = static_cast<float>(of.focal_y());
  axis_x = static_cast<float>(-of.camera.left * of.focal_x());
  axis_y = static_cast<float>(-of.camera.bottom * of.focal_y());
  double farthest = 0;
  if (!view.skeleton->scene_nodes.empty()) {
    const Box box = view.skeleton->lattices[0].box(view.skeleton->scene_nodes[0].box);
    for (int corner = 0; corner < 8; ++corner)
      farthest = std::max(farthest, glm::distance(box.corner(corner), clip.reference));
  }
  const double moved = share_of_distance * farthest;
  step = static_cast<float>(clip.orthographic ? moved : moved / clip.near);
  snapping = static_cast<float>(most_snapping / std::max(of.focal_x(), of.focal_y()));
  snapped = snapping * static_cast<float>(view.rules.layers_lie_close ? rest : 1);
  parallel = clip.orthographic ? static_cast<float>(1 / clip.range) : 0;
}

}  // namespace triptych
