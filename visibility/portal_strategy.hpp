// The strategy `portals`: what lies behind walls is left out, without a test against depth.
#pragma once

#include "visibility/portal_view.hpp"
#include "visibility/strategy.hpp"

#include <memory>

namespace triptych {

/// Draws what of the cut may be seen through portals. In views that PortalView does not apply to
/// (orthographic ones, and where something is hidden or cut away) it draws the whole cut. Does not use the
/// target.
class PortalStrategy final : public ExactStrategy {
 public:
  /// cells: of the pack that the frames are of.
  explicit PortalStrategy(std::shared_ptr<const CellGraph> cells);

  const std::string& name() const override;
  const CullResult& run(const FrameView& view, const VisibleSet& previous, FrameTarget& target,
                        CullSink& sink) override;

 private:
  void list_seen(const FrameView& view);

  std::shared_ptr<const CellGraph> cells_;
  PortalView portals_;
  CutLister whole_cut_;
  std::vector<SceneNodeId> open_;
  CullResult result_;
  CullPacket packet_;
};

}  // namespace triptych
