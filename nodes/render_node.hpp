// The render node: sends cameras, takes visible sets in, draws the pictures. It culls nothing itself.
#pragma once

#include "nodes/frame_record.hpp"
#include "nodes/inbox.hpp"
#include "nodes/picture_stage.hpp"

#include <functional>

namespace triptych {

struct RenderNodeOptions {
  /// Cameras released a second; 0: as fast as frames come.
  double rate = 0;
  /// Called after each frame with its picture; may complete the record.
  std::function<void(FrameRecord&, const Target&)> on_picture;
  /// Called once, before the first frame, with the switch nodes' clocks against this process's.
  std::function<void(const std::vector<PeerClock>&)> on_clocks = {};
};

/// Plays the frames, which must be numbered 0, 1, 2 …, and returns what each was. At most two are in flight:
/// camera i+2 is sent when picture i stands. A context must be current, and the mailbox connected. PeerLost
/// or Error where the session cannot go on; a signal ends it early, with the frames so far.
std::vector<FrameRecord> run_render_node(const Pack& pack, Mailbox& mailbox,
                                         const std::vector<FrameRequest>& frames,
                                         const RenderNodeOptions& options);

}  // namespace triptych
