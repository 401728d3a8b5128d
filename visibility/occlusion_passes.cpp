#include "visibility/occlusion_passes.hpp"

namespace triptych {

OcclusionPasses::OcclusionPasses(const Hierarchy& hierarchy, const CullOptions& options, uint32_t min_pixels)
    : cut_(hierarchy.skeleton()),
      mapper_(hierarchy.skeleton()),
      cull_(hierarchy, options, min_pixels),
      is_represented_(hierarchy.skeleton().drawables.size()) {}

void OcclusionPasses::begin(const FrameView& view, FrameTarget& target) {
  cut_.begin(view);
  is_represented_.clear();
  represented_.clear();
  target.begin(view);
}

void OcclusionPasses::add(const VisibleSet& visible, FrameTarget& target) {
  fresh_.clear();
  for (const DrawableId id : mapper_.map(cut_, visible)) {
    if (is_represented_.mark_first(id)) fresh_.push_back(id);
  }
  represented_.insert(represented_.end(), fresh_.begin(), fresh_.end());
  target.draw(fresh_);
}

const CullResult& OcclusionPasses::run(const FrameView& view, const VisibleSet& previous, FrameTarget& target,
                                       CullSink& sink) {
  return cull_.run(view, cut_, target, represented_, previous, sink);
}

}  // namespace triptych
