// The render node: sends cameras, receives visible sets, draws the pictures; by itself where a switch node is
// missing.
#pragma once

#include "nodes/cost_model.hpp"
#include "nodes/frame_source.hpp"
#include "nodes/peers.hpp"
#include "nodes/session_rules.hpp"

#include <functional>

namespace triptych {

struct RenderNodeOptions {
  /// Cameras released per second; 0: as fast as frames come.
  double rate = 0;
  /// A visible set that takes longer ends the epoch, unless frames take so long: FramePatience says how much
  /// longer it may be then.
  std::chrono::milliseconds timeout{500};
  /// How long the first frame may wait for both switch nodes, so that it is drawn together. Without, the
  /// render node begins alone, and they join it.
  std::chrono::milliseconds gather{0};
  DeviceOptions device = {};
  /// Of frames that have no room within the device's caps.
  MemoryKeeper::NoPixelError no_pixel_error = MemoryKeeper::NoPixelError::fails;
  FrameRules frame_rules = injected_frame_rules();
  StrategyKind strategy = StrategyKind::occlusion;  ///< while it draws by itself; an exact one
  CullOptions cull = {};
  Peers::Connect connect = {};
  /// Another render node drew the frames before: this one does not gather.
  bool successor = false;
  SessionRules session_rules = {};
  /// Milliseconds that the busiest role may take for a frame: pixel errors are raised to keep them. 0: none.
  double target_ms = 0;
  /// Whether this role is to end; asked several times a second.
  std::function<bool()> stop = stop_requested;
};

/// What a render node has done.
struct RenderNodeSummary {
  uint64_t frames = 0;
  uint64_t fallback_frames = 0;  ///< of those, drawn by the render node by itself
  uint64_t epochs = 0;
  CostCoefficients cost_coefficients{};  ///< of what frames cost, where they were steered
  DrawingMemory memory{};
};

/// Draws every frame of the source, in order, and hands each to the sink. At most two are in flight: camera
/// i+2 is sent when picture i is drawn. Where the visible set of a frame does not arrive in time, or a switch
/// node is lost, this and the following frames are drawn by the local pipeline in the same context, from the
/// same cut, until both switch nodes are there; those records say so. Between frames it looks after the
/// switch nodes, too. A context must be current. Returns after the last frame, or earlier, after a whole
/// frame, where `stop` says so. Nothing that a switch node does makes it end.
///
/// Within caps of memory the pixel error of a camera is raised before it is sent. A frame that has no room
/// all the same is drawn by the local pipeline at a larger one, while the switch nodes go on.
RenderNodeSummary run_render_node(const Pack& pack, FrameSource& source, FrameSink& sink,
                                  const RenderNodeOptions& options);

}  // namespace triptych
