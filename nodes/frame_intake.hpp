// Receives one frame's visible set from HC: packet by packet, checked by the digest, requested again where it
// differs.
#pragma once

#include "nodes/inbox.hpp"
#include "nodes/session_rules.hpp"
#include "scene/frame_state.hpp"
#include "visibility/visible_stream.hpp"

namespace triptych {

/// How a frame's intake ended.
struct IntakeResult {
  VisibleSet visible;  ///< V(i)
  Sentinel sentinel;
  /// What came in packets was not V(i); `visible` is the full set, which HC sent again.
  bool digest_mismatch = false;
  double waiting_ms = 0;  ///< for HC's messages
  double sent_ms = 0;     ///< when HC sent the sentinel, by this process's steady clock
  /// The part of waiting_ms while the sentinel was on its way; 0 if it had arrived already.
  double network_ms = 0;
};

/// Receives V(i) of the frame, whose predecessor V(i−1) is `previous`. decided: called with drawables of V(i)
/// in draw rank order as they are decided. After a digest mismatch what was decided is void: draw `visible`
/// anew. HC is lost if the full set does not match its digest either.
Awaited<IntakeResult> take_frame(Inbox& inbox, const Skeleton& skeleton, uint64_t pack_hash,
                                 const FrameRequest& frame, const VisibleSet& previous,
                                 const std::function<void(const std::vector<DrawableId>&)>& decided,
                                 const SessionRules& rules = {});

}  // namespace triptych
