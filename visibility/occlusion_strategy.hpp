// The strategy `occlusion`: draws what was visible one frame ago, and tests everything else against it.
#pragma once

#include "visibility/hardware_cull.hpp"
#include "visibility/map_to_cut.hpp"
#include "visibility/strategy.hpp"

#include <vector>

namespace triptych {

/// The representation and the cull of interactive-display-2003 §4, over one lazily selected cut a frame: OR
/// and HC of a frame are played on one object, by a switch node in two frames or by the local pipeline in
/// one.
class OcclusionStrategy final : public ExactStrategy, private OcclusionRepresentation {
 public:
  explicit OcclusionStrategy(const Hierarchy& hierarchy, const CullOptions& options = {});

  const std::string& name() const override;
  OcclusionRepresentation* representation() override { return this; }
  const CullResult& run(const FrameView& view, const VisibleSet& previous, FrameTarget& target,
                        CullSink& sink) override;

  /// Of the frame that was begun last: what its cut has where anybody looked, and where the caller looks now.
  LazyCut& cut() { return cut_; }

 private:
  void begin(const FrameView& view, FrameTarget& target) override;
  void add(const VisibleSet& visible, FrameTarget& target) override;
  std::span<const DrawableId> drawables() const override { return represented_; }

  LazyCut cut_;
  CutMapper mapper_;
  HardwareCull cull_;
  EpochMarks is_represented_;
  std::vector<DrawableId> represented_, fresh_;
};

}  // namespace triptych
