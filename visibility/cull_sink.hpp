// Where a strategy's decisions go while it runs.
#pragma once

#include "lod/draw_rank.hpp"
#include "visibility/visible_set.hpp"

namespace triptych {

/// A piece of a frame's delta V(i−1) → V(i). Every drawable whose draw rank is below the watermark is
/// decided.
struct CullPacket {
  DrawRank watermark;
  VisibleDelta delta;  ///< of the piece; each list ascending
};

/// Is given each packet, in draw rank order, while the frame is being culled. The packet is valid during
/// the call.
class CullSink {
 public:
  virtual ~CullSink() = default;
  virtual void take(const CullPacket& packet) = 0;
};

/// Ignores packets: for callers that only use the whole set.
class NoSink final : public CullSink {
 public:
  void take(const CullPacket&) override {}
};

}  // namespace triptych
