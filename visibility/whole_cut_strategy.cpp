#include "visibility/whole_cut_strategy.hpp"

#include <algorithm>

namespace triptych {

WholeCutStrategy::WholeCutStrategy(FrustumCulling culling) : culling_(culling) {}

const std::string& WholeCutStrategy::name() const {
  static const std::string frustum = "frustum", none = "none";
  return culling_ == FrustumCulling::on ? frustum : none;
}

const CullResult& WholeCutStrategy::run(const FrameView& view, const VisibleSet& previous, FrameTarget&,
                                        CullSink& sink) {
  result_.clear();
  const std::vector<DrawableId>& cut = lister_.list(view, culling_);
  result_.visible.assign(cut.begin(), cut.end());
  result_.selected = cut.size();
  std::sort(result_.visible.begin(), result_.visible.end());
  packet_.watermark = everything_decided;
  difference(previous, result_.visible, packet_.delta);
  sink.take(packet_);
  return result_;
}

}  // namespace triptych
