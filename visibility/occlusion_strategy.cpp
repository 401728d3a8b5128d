#include "visibility/occlusion_strategy.hpp"

#include <fmt/core.h>

namespace triptych {

OcclusionStrategy::OcclusionStrategy(const Hierarchy& hierarchy, const CullOptions& options)
    : passes_(hierarchy, options, 1) {}

const std::string& OcclusionStrategy::name() const {
  static const std::string name = "occlusion";
  return name;
}

const CullResult& OcclusionStrategy::run(const FrameView& view, const VisibleSet& previous,
                                         FrameTarget& target, CullSink& sink) {
  return passes_.run(view, previous, target, sink);
}

ApproximateOcclusionStrategy::ApproximateOcclusionStrategy(const Hierarchy& hierarchy,
                                                           const CullOptions& options, uint32_t min_pixels)
    : passes_(hierarchy, options, min_pixels), min_pixels_(min_pixels) {}

const std::string& ApproximateOcclusionStrategy::name() const {
  static const std::string name = "approximate";
  return name;
}

std::string ApproximateOcclusionStrategy::may_miss() const {
  return fmt::format(
      "drawables that own fewer than {} pixels of the un-culled picture each; several of them may own more "
      "together",
      min_pixels_);
}

const CullResult& ApproximateOcclusionStrategy::run(const FrameView& view, const VisibleSet& previous,
                                                    FrameTarget& target, CullSink& sink) {
  return passes_.run(view, previous, target, sink);
}

}  // namespace triptych
