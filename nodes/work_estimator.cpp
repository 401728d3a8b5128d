#include "nodes/work_estimator.hpp"

namespace triptych {

WorkEstimator::WorkEstimator(const Skeleton& skeleton)
    : skeleton_(skeleton),
      covered_(skeleton.lattice()),
      cut_(skeleton),
      mapper_(skeleton),
      loaded_(skeleton.chunks.size()),
      counted_(skeleton.chunks.size()) {}

FrameWork WorkEstimator::estimate(const FrameView& view, const VisibleSet& previous) {
  /// Of its drawable's rectangle for each triangle: there it counts half as a large one. Gradually, so that
  /// the work does not jump where a drawable comes nearer.
  constexpr double many_pixels = 8;
  cut_.begin(view);
  covered_.begin(view);
  counted_.clear();
  FrameWork work{.megapixels = 1e-6 * view.view().width * view.view().height};
  for (const DrawableId id : mapper_.map(cut_, previous)) {
    const Drawable& drawable = skeleton_.drawables[id];
    work.triangles += drawable.triangles;
    work.drawables += 1;
    const double covered = covered_.by(view.box(drawable.scene_node));
    work.covered_megapixels += 1e-6 * covered;
    if (covered > 0)
      work.large_triangles += drawable.triangles * covered / (covered + many_pixels * drawable.triangles);
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
