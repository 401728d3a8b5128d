#include "nodes/work_estimator.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace triptych {

WorkEstimator::WorkEstimator(const Skeleton& skeleton)
    : skeleton_(skeleton),
      cut_(skeleton),
      mapper_(skeleton),
      loaded_(skeleton.chunks.size()),
      counted_(skeleton.chunks.size()) {}

/// Of the square around the sphere around its box, at most the whole picture.
double WorkEstimator::covered_pixels(const FrameView& view, const SceneNode& node) const {
  const Box box = skeleton_.lattice().box(node.box);
  const double diameter = glm::length(box.hi - box.lo);
  const double picture = static_cast<double>(view.view().width) * view.view().height;
  const double depth =
      view.view().camera.orthographic() ? 1 : view.eye_space.bounds(node.box).min_depth + diameter / 2;
  const double side = view.focal_length * diameter;
  return side * side < picture * depth * depth ? side * side / (depth * depth) : picture;
}

FrameWork WorkEstimator::estimate(const FrameView& view, const VisibleSet& previous) {
  cut_.begin(view);
  counted_.clear();
  FrameWork work{.megapixels = 1e-6 * view.view().width * view.view().height};
  for (const DrawableId id : mapper_.map(cut_, previous)) {
    const Drawable& drawable = skeleton_.drawables[id];
    work.triangles += drawable.triangles;
    work.drawables += 1;
    work.covered_megapixels += 1e-6 * covered_pixels(view, skeleton_.scene_nodes[drawable.scene_node]);
    for (uint32_t i = 0; i < drawable.placement_count; ++i) {
      const uint32_t chunk = skeleton_.placements[drawable.first_placement + i].chunk;
      if (!loaded_.marked(chunk) && counted_.mark_first(chunk))
        work.new_triangles += skeleton_.chunks[chunk].triangle_count;
    }
  }
  return work;
}

void WorkEstimator::loaded(const std::vector<DrawableId>& drawn) {
  for (const DrawableId id : drawn) {
    const Drawable& drawable = skeleton_.drawables[id];
    for (uint32_t i = 0; i < drawable.placement_count; ++i)
      loaded_.mark(skeleton_.placements[drawable.first_placement + i].chunk);
  }
}

}  // namespace triptych
