// The strategies `frustum` and `none`: the whole cut, without a test.
#pragma once

#include "visibility/strategy.hpp"

namespace triptych {

/// `frustum` draws the cut; `none` draws the rest of the model too, at the detail that its distance asks for.
/// Neither uses the target.
class WholeCutStrategy final : public ExactStrategy {
 public:
  explicit WholeCutStrategy(FrustumCulling culling);

  const std::string& name() const override;
  FrustumCulling reference() const override { return culling_; }
  const CullResult& run(const FrameView& view, const VisibleSet& previous, FrameTarget& target,
                        CullSink& sink) override;

 private:
  FrustumCulling culling_;
  CutLister lister_;
  CullResult result_;
  CullPacket packet_;
};

}  // namespace triptych
