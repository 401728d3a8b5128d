// A receiver's side of one frame: V(i) grows out of V(i−1) as packets arrive, and may be drawn as far as it
// is decided.
#pragma once

#include "lod/draw_rank.hpp"
#include "lod/frame_view.hpp"
#include "visibility/cull_sink.hpp"
#include "visibility/visible_set.hpp"

#include <string>

namespace triptych {

/// Takes the packets of one frame in order.
class VisibleStream {
 public:
  /// state: of frame i; previous: V(i−1). Draw ranks do not depend on what is hidden, which need not be
  /// known.
  VisibleStream(const Skeleton& skeleton, FrameState state, const VisibleSet& previous);

  /// The drawables of V(i) that this packet decided, after those of earlier packets in draw rank order. Ids
  /// that make no sense (removed but not in the set, added twice, beyond the skeleton) are counted as
  /// faults and left out; then the digest will not match.
  std::vector<DrawableId> take(const CullPacket& packet);

  /// V(i), as far as the packets have arrived.
  const VisibleSet& visible() const { return visible_; }
  uint64_t faults() const { return faults_; }

 private:
  FrameView view_;
  VisibleSet visible_;
  /// Of visible_, ascending; those below the watermark have been given out.
  std::vector<DrawRank> undecided_;
  uint64_t faults_ = 0;
};

}  // namespace triptych
