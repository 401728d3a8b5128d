#include "view/picker.hpp"

#include "scene/hidden_objects.hpp"
#include "scene/ray.hpp"
#include "view/shown_nodes.hpp"

#include <cmath>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <queue>
#include <utility>
#include <vector>

namespace triptych {

EyeRay eye_ray(const View& view, double x, double y) {
  const Camera& camera = view.camera;
  const glm::dmat3 axes = glm::transpose(view.rotation());  // right, up, backward
  const double right = camera.left + (camera.right - camera.left) * x / view.width;
  const double up = camera.top - (camera.top - camera.bottom) * y / view.height;
  const glm::dvec3 aside = right * axes[0] + up * axes[1];
  if (camera.orthographic()) return {camera.eye + aside, -axes[2], camera.near};
  return {camera.eye, aside - axes[2], camera.near};
}

glm::dvec3 Picker::place_at(const View& view, double x, double y, double depth) {
  const EyeRay ray = eye_ray(view, x, y);
  return ray.from + depth * ray.way;
}

std::optional<Picked> Picker::at(const FrameState& frame, std::span<const DrawableId> shown, double x,
                                 double y) {
  const EyeRay eye = eye_ray(frame.view, x, y);
  const ShownNodes nodes(pack_.skeleton(), shown);
  return nearest(kept_part(eye.from, eye.way, eye.near, SectionSides(frame.section)), frame,
                 [&](SceneNodeId node) { return nodes.of(node); });
}

std::optional<Picked> Picker::along(const FrameState& frame, const glm::dvec3& from, const glm::dvec3& way,
                                    double least) {
  const std::vector<SceneNode>& nodes = pack_.skeleton().scene_nodes;
  return nearest(kept_part(from, way, least, SectionSides(frame.section)), frame, [&](SceneNodeId node) {
    return nodes[node].child_count > 0 ? no_id : nodes[node].first_drawable;
  });
}

template <typename DrawableOf>
std::optional<Picked> Picker::nearest(PlacedRay ray, const FrameState& frame, const DrawableOf& drawable_of) {
  const Skeleton& skeleton = pack_.skeleton();
  const HiddenObjects* const hidden = frame.hiding.objects.get();
  const std::shared_ptr<const Poses> poses = poses_of(skeleton, frame);
  const RaySpan span(ray.from, ray.way, ray.least, ray.most);
  std::optional<Picked> found;
  using Entry = std::pair<double, SceneNodeId>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;  // the nearest box first
  const auto add = [&](SceneNodeId node) {
    // A cut surface may be before the box of the back behind it, or before that of what is cut away.
    const LatticeBox& always = skeleton.scene_nodes[node].box;
    const bool moves = poses && poses->moves(node);
    if (moves && !poses->is_there(node)) return;
    // All of what moves, since its divided bodies are somewhere in it.
    const LatticeBox own = moves ? poses->instance_box(skeleton.lattice(), node, always) : always;
    const LatticeBox box =
        ray.entered && !moves ? skeleton.closed.reach(node, skeleton.scene_nodes[node]) : own;
    const double entry = span.entry(skeleton.lattice().box(box));
    if (entry <= ray.most && std::isfinite(entry)) open.emplace(entry, node);
  };
  if (!skeleton.scene_nodes.empty()) add(0);
  while (!open.empty() && open.top().first <= ray.most) {
    const SceneNodeId at = open.top().second;
    open.pop();
    const SceneNode& node = skeleton.scene_nodes[at];
    const DrawableId drawable = drawable_of(at);
    if (drawable == no_id) {
      for (uint32_t i = 0; i < node.child_count; ++i) add(node.first_child + i);
      continue;
    }
    const Drawable& placed = skeleton.drawables[drawable];
    for (uint32_t i = 0; i < placed.placement_count; ++i) {
      if (hidden && hidden->hides(placed.scene_node, i)) continue;
      const Placement& placement = skeleton.placements[placed.first_placement + i];
      const auto hit =
          meet(ray, skeleton, placement, placed_transform(skeleton, poses.get(), placement), chunks_);
      if (!hit) continue;
      ray.most = hit->along;
      found = Picked{drawable, i, hit->triangle, ray.from + hit->along * ray.way, hit->normal};
    }
  }
  return found;
}

}  // namespace triptych
