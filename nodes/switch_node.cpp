#include "nodes/switch_node.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/spent_time.hpp"
#include "base/threads.hpp"
#include "nodes/frame_intake.hpp"
#include "nodes/hidden_sets.hpp"
#include "nodes/pack_strategy.hpp"
#include "nodes/streaming.hpp"
#include "protocol/delta_codec.hpp"
#include "protocol/digest.hpp"

#include <optional>

namespace triptych {

namespace {

/// What is kept from epoch to epoch.
struct LastingState {
  LastingState(const Pack& of_pack, Role role, const SwitchNodeOptions& with)
      : pack(of_pack),
        self(role),
        options(with),
        hidden(of_pack),
        device(of_pack, with.device),
        strategy(make_strategy(of_pack, device.hierarchy(), with)) {}
  static std::unique_ptr<ExactStrategy> make_strategy(const Pack& of, const Hierarchy& hierarchy,
                                                      const SwitchNodeOptions& with) {
    const StrategyChoice choice = choose_strategy(of, with.strategy, {.batches = with.cull});
    return make_exact_strategy(choice.kind, hierarchy, choice.options);
  }

  const Pack& pack;
  Role self;
  const SwitchNodeOptions& options;
  HiddenSets hidden;
  PackDevice device;
  std::unique_ptr<ExactStrategy> strategy;  ///< a session claims that its pictures are the un-culled ones
  std::unique_ptr<FrameTarget> target;      ///< of the size of the last camera
  std::optional<OcclusionStage> stage;
  std::optional<OccluderStreaming> streaming;  ///< where there are caps
  SwitchNodeSummary done;

  SwitchNodeSummary summary() {
    SwitchNodeSummary summary = done;
    summary.memory.geometry = device.device().geometry_use();
    if (device.read_ahead()) summary.memory.read_ahead = device.read_ahead()->use();
    return summary;
  }
};

class Epoch {
 public:
  Epoch(LastingState& node, Mailbox& mailbox)
      : node_(node),
        inbox_(mailbox, &sets_, node.options.stop),
        peer_(node.self == Role::switch_0 ? Role::switch_1 : Role::switch_0) {}

  Ending run() {
    for (;;) {
      if (const auto ending = take(inbox_.first_camera())) return *ending;
      if (!camera_.warm_up) break;
      if (const auto ending = warm_up()) return *ending;
    }
    if (hardware_cull_role(camera_.frame) == node_.self) begin(camera_);
    for (uint32_t frame = camera_.frame;; ++frame) {
      if (hardware_cull_role(frame) == node_.self) {
        if (const auto ending = cull(frame)) return *ending;
        if (camera_.last) return inbox_.wait_for_end();
        // This node is OR in the next frame, and needs its camera next.
        if (const auto ending = take(inbox_.camera(frame + 1))) return *ending;
      } else {
        if (camera_.last) return inbox_.wait_for_end();
        if (const auto ending = represent(frame)) return *ending;
      }
    }
  }

 private:
  static FrameRequest request(const CameraMessage& camera) { return {camera.frame, camera.state}; }

  /// The next camera, with what is hidden in it: that set came before it.
  std::optional<Ending> take(Awaited<CameraMessage> next) {
    if (!next) return next.ending();
    camera_ = std::move(*next);
    try {
      for (const HiddenSet& set : inbox_.hidden_sets()) node_.hidden.add(set);
      node_.hidden.complete(camera_.state);
    } catch (const Error& error) {
      return ending_of_lost(Role::render, fmt::format("frame {}: {}", camera_.frame, error.what()));
    }
    return std::nullopt;
  }

  void begin(const CameraMessage& camera) {
    const View& view = camera.state.view;
    if (!node_.stage || node_.target->width() != view.width || node_.target->height() != view.height) {
      node_.stage.reset();
      node_.target = node_.device.device().make_target(TargetKind::depth_only, view.width, view.height);
      node_.stage.emplace(node_.device.skeleton(), *node_.target, *node_.strategy, node_.options.frame_rules);
    }
    if (node_.device.read_ahead() != nullptr) {
      if (!node_.streaming) node_.streaming.emplace(node_.device, node_.options.device.memory, camera.state);
      node_.streaming->begin_frame(camera.warm_up);
    }
    node_.stage->begin(request(camera));
  }

  /// Runs all stages of the frame once, so that its geometry and programs are on the graphics card.
  std::optional<Ending> warm_up() {
    begin(camera_);
    NoSink nobody;
    const VisibleSet visible = node_.stage->cull({}, nobody).visible;
    begin(camera_);
    node_.stage->represent(visible);
    node_.stage->finish();
    return inbox_.send(Role::render, Channel::nodes, Ready{camera_.frame});
  }

  /// To OR and to the render node.
  std::optional<Ending> send_to_both(const Message& message) {
    if (auto ending = inbox_.send(peer_, Channel::nodes, message)) return ending;
    return inbox_.send(Role::render, Channel::nodes, message);
  }

  /// Sends each packet of a frame to the other two as it is decided.
  class PacketSender final : public CullSink {
   public:
    PacketSender(Epoch& epoch, Sentinel& sentinel) : epoch_(epoch), sentinel_(sentinel) {}
    void take(const CullPacket& packet) override {
      if (ending_) return;  // the rest would not arrive
      sentinel_.added += static_cast<uint32_t>(packet.delta.added.size());
      sentinel_.removed += static_cast<uint32_t>(packet.delta.removed.size());
      const SessionRules& rules = epoch_.node_.options.session_rules;
      VisibleDelta delta = packet.delta;
      if (rules.withholds_added && !delta.added.empty()) delta.added.pop_back();
      rules.slow_down();
      ending_ = epoch_.send_to_both(
          DeltaMessage{sentinel_.frame, packet.watermark, encode_delta(delta, epoch_.sets_.latest())});
    }
    /// What ended the epoch meanwhile, if anything did.
    const std::optional<Ending>& ending() const { return ending_; }

   private:
    Epoch& epoch_;
    Sentinel& sentinel_;
    std::optional<Ending> ending_;
  };

  /// HC in frame i: R(i) is drawn, V(i−1) is known.
  std::optional<Ending> cull(uint32_t frame) {
    const StageWatch watch;
    const VisibleSet& previous = sets_.latest();
    Sentinel sentinel{.frame = frame, .visible = 0, .added = 0, .removed = 0, .digest = 0, .times = {}};
    PacketSender sender(*this, sentinel);
    const CullResult& result = node_.stage->cull(previous, sender);
    if (sender.ending()) return sender.ending();
    sets_.add(frame, result.visible);
    sentinel.visible = static_cast<uint32_t>(result.visible.size());
    sentinel.digest = frame_digest(frame, camera_.state, node_.pack.content_hash(), result.visible);
    const SpentTime spent = watch.spent();
    sentinel.times = {.hardware_cull_ms = to_the_microsecond(spent.wall_ms),
                      .hardware_cull_cpu_ms = to_the_microsecond(spent.cpu_ms / thread_count()),
                      .queries = static_cast<uint32_t>(result.tests),
                      .cut_size = static_cast<uint32_t>(result.selected),
                      .sent_at_ms = to_the_microsecond(steady_milliseconds())};
    if (auto lost = send_to_both(sentinel)) return lost;
    if (node_.streaming) node_.streaming->drawn();
    ++node_.done.culled;
    return std::nullopt;
  }

  /// OR in frame i: V(i) comes in, R(i+1) is drawn from it.
  std::optional<Ending> represent(uint32_t frame) {
    const FrameRequest current = request(camera_);
    const Stopwatch waiting;
    if (auto ending = take(inbox_.camera(frame + 1))) return ending;
    const double camera_waiting_ms = waiting.milliseconds();
    const double began_at_ms = steady_milliseconds();
    const StageWatch whole;
    begin(camera_);
    Awaited<IntakeResult> intake = take_frame(
        inbox_, node_.pack.skeleton(), node_.pack.content_hash(), current, sets_.latest(),
        [&](const std::vector<DrawableId>& decided) {
          node_.options.session_rules.slow_down();
          node_.stage->represent(decided);
        },
        node_.options.session_rules);
    if (!intake) return intake.ending();
    node_.options.session_rules.slow_down();
    if (intake->digest_mismatch) {
      begin(camera_);
      node_.stage->represent(intake->visible);
    }
    node_.stage->finish();
    const SpentTime spent = whole.spent();
    sets_.add(frame, std::move(intake->visible));
    ++node_.done.represented;
    return inbox_.send(
        Role::render, Channel::nodes,
        SwitchReport{.frame = frame,
                     .began_at_ms = to_the_microsecond(began_at_ms),
                     .occlusion_representation_ms = to_the_microsecond(spent.wall_ms - intake->waiting_ms),
                     .occlusion_representation_cpu_ms = to_the_microsecond(spent.cpu_ms / thread_count()),
                     .camera_waiting_ms = to_the_microsecond(camera_waiting_ms),
                     .packets_waiting_ms = to_the_microsecond(intake->waiting_ms),
                     .drawables = static_cast<uint32_t>(node_.stage->represented().size()),
                     .triangles = node_.stage->represented_triangles()});
  }

  LastingState& node_;
  RecentSets sets_;
  Inbox inbox_;
  Role peer_;
  CameraMessage camera_;  ///< of the current frame; after represent(), of the next one
};

}  // namespace

SwitchNodeSummary run_switch_node(const Pack& pack, Role self, EpochSink& sink,
                                  const SwitchNodeOptions& options) {
  LastingState node(pack, self, options);
  for (bool again = false;; again = true) {
    const std::unique_ptr<Mailbox> mailbox = options.connect(again);
    if (!mailbox) return node.summary();
    ++node.done.epochs;
    Ending ending;
    try {
      ending = Epoch(node, *mailbox).run();
    } catch (const std::exception& error) {
      mailbox->leave(error.what());
      throw;
    }
    switch (ending.cause) {
      case Ending::Cause::peer_lost:
        mailbox->leave(ending.reason);
        sink.epoch_ended(*mailbox, ending.reason);
        break;
      // The session is over for the peers too, unless only this role was told to end.
      case Ending::Cause::session_over:
        mailbox->leave("");
        sink.epoch_ended(*mailbox, "");
        return node.summary();
      case Ending::Cause::stopped:
        mailbox->leave("told to end");
        sink.epoch_ended(*mailbox, "");
        return node.summary();
    }
  }
}

}  // namespace triptych
