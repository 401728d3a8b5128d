// The strategies `occlusion` and `approximate`: draw what was visible one frame ago, and test everything
// against it.
#pragma once

#include "visibility/occlusion_passes.hpp"

#include <string>

namespace triptych {

/// `occlusion`: what shows at one pixel is drawn.
class OcclusionStrategy final : public ExactStrategy {
 public:
  explicit OcclusionStrategy(const Hierarchy& hierarchy, const CullOptions& options = {});

  const std::string& name() const override;
  OcclusionRepresentation* representation() override { return &passes_; }
  const CullResult& run(const FrameView& view, const VisibleSet& previous, FrameTarget& target,
                        CullSink& sink) override;

  /// The lazily selected cut of the frame that was begun last.
  LazyCut& cut() { return passes_.cut(); }

 private:
  OcclusionPasses passes_;
};

/// `approximate`: the same, but a box that shows at fewer pixels than a threshold is hidden. Occlusion
/// queries count pixels, and interactive-display-2003 §4 only asks for any.
///
/// Each drawable that it leaves out owns fewer than so many pixels of the un-culled picture of the cut: where
/// it owns one, its boxes are at or in front of whatever was drawn, and all boxes that it is tested by are
/// counted together. What a drawable has drawn into the representation is not subtracted, so what was visible
/// one frame ago is held to the same rule. A threshold of 1 gives the visible sets of `occlusion`.
class ApproximateOcclusionStrategy final : public ApproximateStrategy {
 public:
  /// min_pixels: the threshold, at least 1.
  ApproximateOcclusionStrategy(const Hierarchy& hierarchy, const CullOptions& options, uint32_t min_pixels);

  const std::string& name() const override;
  std::string may_miss() const override;
  OcclusionRepresentation* representation() override { return &passes_; }
  const CullResult& run(const FrameView& view, const VisibleSet& previous, FrameTarget& target,
                        CullSink& sink) override;

 private:
  OcclusionPasses passes_;
  uint32_t min_pixels_;
};

}  // namespace triptych
