// A switch node: HC in every other frame, OR in the frames between, epoch after epoch.
#pragma once

#include "nodes/frame_source.hpp"
#include "nodes/inbox.hpp"
#include "nodes/injected_rules.hpp"
#include "nodes/occlusion_stage.hpp"
#include "nodes/pack_device.hpp"
#include "nodes/session_rules.hpp"
#include "visibility/strategies.hpp"

#include <functional>
#include <memory>

namespace triptych {

struct SwitchNodeOptions {
  DeviceOptions device = {};
  FrameRules frame_rules = injected_frame_rules();
  StrategyKind strategy = StrategyKind::occlusion;  ///< an exact one
  CullOptions cull = {};
  /// Connects both peers: for the first epoch, or for another one after a loss (`again`). Null where the
  /// session is over.
  std::function<std::unique_ptr<Mailbox>(bool again)> connect = {};
  SessionRules session_rules = {};
  /// Whether this role is to end; asked several times a second.
  std::function<bool()> stop = stop_requested;
};

/// What a switch node has done.
struct SwitchNodeSummary {
  uint64_t culled = 0, represented = 0;  ///< frames as HC and as OR
  uint64_t epochs = 0;
  DrawingMemory memory{};
};

/// Runs the role. An epoch ends when a peer is lost: then all links are closed, and connect is called again;
/// it begins with an empty visible set, while geometry stays on the graphics card. sink: is told of the end
/// of each epoch. Returns when the session is over or `stop` says so. A context must be current. Error from
/// connect, and for failures of this role itself. Within caps of memory it leaves out of R(i) what it has
/// not, or has no room for: less is hidden then, and nothing that shows.
SwitchNodeSummary run_switch_node(const Pack& pack, Role self, EpochSink& sink,
                                  const SwitchNodeOptions& options);

}  // namespace triptych
