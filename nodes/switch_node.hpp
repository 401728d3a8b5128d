// A switch node: HC in every other frame, OR in the frames between.
#pragma once

#include "nodes/inbox.hpp"
#include "nodes/occlusion_stage.hpp"

namespace triptych {

struct SwitchNodeOptions {
  TestKind test = TestKind::storage;
  CullOptions cull;
};

/// Plays the role until the render node leaves or a signal asks to stop. A context must be current, and the
/// mailbox connected. PeerLost where a peer goes without a word; Error for messages that do not fit.
void run_switch_node(const Pack& pack, Mailbox& mailbox, Role self, const SwitchNodeOptions& options);

}  // namespace triptych
