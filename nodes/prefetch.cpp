#include "nodes/prefetch.hpp"

#include <algorithm>

namespace triptych {

namespace {

View ahead(const View& before, const View& now, double frames) {
  View view = now;
  const auto further = [&](const glm::dvec3& from, const glm::dvec3& to) {
    return to + frames * (to - from);
  };
  view.camera.eye = further(before.camera.eye, now.camera.eye);
  view.camera.target = further(before.camera.target, now.camera.target);
  return view;
}

}  // namespace

/// Whether the visible set has a level of the scene node, or of one right above or below it.
bool Prefetch::shows_now(SceneNodeId node, const VisibleSet& visible) const {
  const Skeleton& skeleton = hierarchy_.skeleton();
  const auto has = [&](SceneNodeId id) {
    const SceneNode& scene_node = skeleton.scene_nodes[id];
    const auto first = std::lower_bound(visible.begin(), visible.end(), scene_node.first_drawable);
    return first != visible.end() && *first < scene_node.first_drawable + scene_node.drawable_count;
  };
  if (has(node)) return true;
  const SceneNode& scene_node = skeleton.scene_nodes[node];
  if (scene_node.parent != no_id && has(scene_node.parent)) return true;
  for (uint32_t child = 0; child < scene_node.child_count; ++child) {
    if (has(scene_node.first_child + child)) return true;
  }
  return false;
}

void Prefetch::drawn(const FrameView& view, const VisibleSet& visible, const View* next_view) {
  const std::optional<View> before = last_;
  last_ = view.view();
  if (next_view) expect(view, *next_view, 2, visible);
  if (!before || before->width != view.view().width || before->height != view.view().height) return;
  // The next frames are urgent; what comes later is read where there is time.
  constexpr double next = 1.5, later = 8;
  if (!next_view) expect(view, ahead(*before, view.view(), next), 2, visible);
  expect(view, ahead(*before, view.view(), later), 0, visible);
}

void Prefetch::expect(const FrameView& view, const View& then_view, float least, const VisibleSet& visible) {
  FrameState state = view.state;
  state.view = then_view;
  if (state.view.camera.eye == state.view.camera.target) return;
  const Skeleton& skeleton = hierarchy_.skeleton();
  const FrameView then(skeleton, state, view.rules);
  uint64_t bytes = 0;
  float place = 0;  // in the order in which they lie behind each other
  for (const DrawableId id : lister_.list(then)) {
    place += 1;
    const bool other_level = shows_now(skeleton.drawables[id].scene_node, visible);
    // What is in the frustum now and does not show is most likely hidden then, too.
    if (!other_level && !view.eye_space.bounds(view.box(skeleton.drawables[id].scene_node)).outside) continue;
    for (const Placement& placement : hierarchy_.placements_of(id)) {
      const uint32_t chunk = placement.chunk;
      if (device_.has_chunk(chunk) || device_.is_damaged(chunk)) continue;
      residency_.expect(chunk, least + (other_level ? 1 : 0) + 1 / place);
      bytes += skeleton.chunks[chunk].size;
    }
    if (bytes > bytes_) return;
  }
}

}  // namespace triptych
