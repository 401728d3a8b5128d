// The render node: sends cameras, takes visible sets in, draws the pictures; by itself where a switch node is
// missing.
#pragma once

#include "nodes/frame_record.hpp"
#include "nodes/local_pipeline.hpp"
#include "nodes/peers.hpp"
#include "nodes/picture_stage.hpp"

#include <functional>

namespace triptych {

/// What is to be drawn: frames `first` to `count` − 1, as they come about: a frame is asked for when its
/// camera is released, once each and in order, and nobody knows it before.
struct FrameSource {
  uint32_t first = 0, count = 0;
  std::function<FrameRequest(uint32_t)> frame;  ///< its number is the argument
  /// Whether there is a next one; may wait a moment for it where `may_wait`. Without it there always is.
  std::function<bool(bool may_wait)> ready = {};
  /// Whether no further one will come although `count` is not reached. Without it there always will.
  std::function<bool()> finished = {};
};

struct RenderNodeOptions {
  /// Cameras released a second; 0: as fast as frames come.
  double rate = 0;
  /// A visible set that takes longer ends the epoch.
  std::chrono::milliseconds timeout{500};
  DeviceOptions device = {};
  FrameRules rules = injected_frame_rules();
  CullOptions cull;
  Peers::Connect connect;
  Peers::OnEnd on_epoch_end;
  /// Begin without waiting for switch nodes: another render node did so before this one.
  bool begin_alone = false;
  /// Hears of the switch nodes' clocks at the beginning of each epoch.
  Peers::OnClocks on_clocks = {};
  /// Called with each frame as soon as its picture stands, before on_picture: shows it to somebody.
  std::function<void(const FrameRequest&, const FrameRecord&, LocalPipeline&)> show = {};
  /// Called after each frame with its picture.
  std::function<void(FrameRecord, const FrameTarget&)> on_picture;
};

/// What a render node has done.
struct RenderNodeSummary {
  uint64_t frames = 0, alone = 0;  ///< of them, drawn by itself
  uint64_t epochs = 0;
};

/// Draws every frame, in order. At most two are in flight: camera i+2 is sent when picture i stands. Where
/// the visible set of a frame does not come in time, or a switch node is lost, this and the following frames
/// are drawn by the fallback's stages in the same context, from the same cut, until both switch nodes are
/// back; those records say so. A context must be current. Error where the first epoch does not come about; a
/// signal ends it early, with a whole frame.
RenderNodeSummary run_render_node(const Pack& pack, const FrameSource& frames,
                                  const RenderNodeOptions& options);

}  // namespace triptych
