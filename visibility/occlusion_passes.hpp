// Occlusion culling of one frame in its two passes: what was visible one frame ago is drawn, and everything
// is tested against it.
#pragma once

#include "visibility/hardware_cull.hpp"
#include "visibility/map_to_cut.hpp"
#include "visibility/strategy.hpp"

#include <vector>

namespace triptych {

/// The occlusion representation (OR) and the hardware cull (HC) of interactive-display-2003 §4, over one
/// lazily selected cut per frame. OR and HC of frame i run on one object: a switch node runs them in two
/// successive frames, the local pipeline in one.
class OcclusionPasses final : public OcclusionRepresentation {
 public:
  /// min_pixels: as HardwareCull has it.
  OcclusionPasses(const Hierarchy& hierarchy, const CullOptions& options, uint32_t min_pixels);

  void begin(const FrameView& view, FrameTarget& target) override;
  void add(const VisibleSet& visible, FrameTarget& target) override;
  std::span<const DrawableId> drawables() const override { return represented_; }
  /// As Strategy::run().
  const CullResult& run(const FrameView& view, const VisibleSet& previous, FrameTarget& target,
                        CullSink& sink);

  /// The lazily selected cut of the frame that was begun last.
  LazyCut& cut() { return cut_; }

 private:
  LazyCut cut_;
  CutMapper mapper_;
  HardwareCull cull_;
  EpochMarks is_represented_;
  std::vector<DrawableId> represented_, fresh_;
};

}  // namespace triptych
