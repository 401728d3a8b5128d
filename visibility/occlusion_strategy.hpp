// The strategy `occlusion`: draws what was visible one frame ago, and tests everything else against it.
#pragma once

#include "visibility/hardware_cull.hpp"
#include "visibility/map_to_cut.hpp"
#include "visibility/strategy.hpp"

#include <vector>

namespace triptych {

/// The occlusion representation (OR) and the hardware cull (HC) of interactive-display-2003 §4, over one
/// lazily selected cut per frame. OR and HC of frame i run on one object: a switch node runs them in two
/// successive frames, the local pipeline in one.
class OcclusionStrategy final : public ExactStrategy, private OcclusionRepresentation {
 public:
  explicit OcclusionStrategy(const Hierarchy& hierarchy, const CullOptions& options = {});

  const std::string& name() const override;
  OcclusionRepresentation* representation() override { return this; }
  const CullResult& run(const FrameView& view, const VisibleSet& previous, FrameTarget& target,
                        CullSink& sink) override;

  /// The lazily selected cut of the frame that was begun last.
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
