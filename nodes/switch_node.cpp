#include "nodes/switch_node.hpp"

#include "base/clock.hpp"
#include "base/inject.hpp"
#include "nodes/frame_intake.hpp"
#include "protocol/delta_codec.hpp"
#include "protocol/digest.hpp"
#include "visibility/strategies.hpp"

#include <optional>

namespace triptych {

namespace {

/// What lasts longer than an epoch.
struct Workshop {
  Workshop(const Pack& of_pack, Role role, const SwitchNodeOptions& with)
      : pack(of_pack),
        self(role),
        options(with),
        device(of_pack, with.device),
        strategy(make_exact_strategy(StrategyKind::occlusion, device.hierarchy(), with.cull)) {}
  const Pack& pack;
  Role self;
  const SwitchNodeOptions& options;
  PackDevice device;
  std::unique_ptr<ExactStrategy> strategy;  ///< a session's pictures are claimed to be the un-culled ones
  std::optional<OcclusionStage> stage;
  int width = 0, height = 0;
  SwitchNodeSummary summary;
};

class Epoch {
 public:
  Epoch(Workshop& workshop, Mailbox& mailbox)
      : shop_(workshop),
        inbox_(mailbox),
        peer_(workshop.self == Role::switch_0 ? Role::switch_1 : Role::switch_0) {
    inbox_.answer_full_set = [this](Role asking, uint32_t frame) { answer(asking, frame); };
  }

  [[noreturn]] void run() {
    camera_ = inbox_.first_camera();
    for (; camera_.rehearsal; camera_ = inbox_.first_camera()) rehearse();
    if (hardware_cull_role(camera_.frame) == shop_.self) begin(camera_);
    for (uint32_t frame = camera_.frame;; ++frame) {
      if (hardware_cull_role(frame) == shop_.self) {
        cull(frame);
        if (camera_.last) inbox_.wait_for_end();
        // This node is OR in the next frame, whose camera it wants next.
        camera_ = inbox_.camera(frame + 1);
      } else {
        if (camera_.last) inbox_.wait_for_end();
        represent(frame);
      }
    }
  }

 private:
  static FrameRequest request(const CameraMessage& camera) {
    return {camera.frame, {camera.view, camera.pixel_error}};
  }

  void begin(const CameraMessage& camera) {
    if (!shop_.stage || shop_.width != camera.view.width || shop_.height != camera.view.height) {
      shop_.width = camera.view.width;
      shop_.height = camera.view.height;
      shop_.stage.emplace(shop_.device.skeleton(), shop_.device.device(), *shop_.strategy, shop_.width,
                          shop_.height, shop_.options.rules);
    }
    shop_.stage->begin(request(camera));
  }

  /// Does what the frame will want, so that its geometry and programs are on the graphics card.
  void rehearse() {
    begin(camera_);
    NoSink nobody;
    const VisibleSet visible = shop_.stage->cull({}, nobody).visible;
    begin(camera_);
    shop_.stage->represent(visible);
    shop_.stage->finish();
    inbox_.mailbox().send(Role::render, Channel::nodes, Ready{camera_.frame});
  }

  void be_slow() const {
    if (shop_.self == Role::switch_1) dawdle(Fault::slow_switch_node);
  }

  /// Sends each packet of a frame to the other two as it is decided.
  class PacketSender final : public CullSink {
   public:
    PacketSender(Epoch& epoch, uint32_t frame, Sentinel& sentinel)
        : epoch_(epoch), frame_(frame), sentinel_(sentinel) {}
    void take(const CullPacket& packet) override {
      sentinel_.added += static_cast<uint32_t>(packet.delta.added.size());
      sentinel_.removed += static_cast<uint32_t>(packet.delta.removed.size());
      VisibleDelta delta = packet.delta;
      if (injected(Fault::wrong_delta) && !delta.added.empty()) delta.added.pop_back();
      const DeltaMessage message{frame_, packet.watermark, encode_delta(delta, epoch_.visible_)};
      epoch_.be_slow();
      epoch_.inbox_.mailbox().send(epoch_.peer_, Channel::nodes, message);
      epoch_.inbox_.mailbox().send(Role::render, Channel::nodes, message);
    }

   private:
    Epoch& epoch_;
    uint32_t frame_;
    Sentinel& sentinel_;
  };

  /// HC in frame i: R(i) stands, V(i−1) is known.
  void cull(uint32_t frame) {
    const Stopwatch stopwatch;
    Sentinel sentinel{.frame = frame, .visible = 0, .added = 0, .removed = 0, .digest = 0, .times = {}};
    PacketSender sender(*this, frame, sentinel);
    const CullResult& result = shop_.stage->cull(visible_, sender);
    previous_visible_ = std::move(visible_);
    visible_ = result.visible;
    visible_frame_ = frame;
    sentinel.visible = static_cast<uint32_t>(visible_.size());
    sentinel.digest =
        frame_digest(frame, camera_.view, camera_.pixel_error, shop_.pack.content_hash(), visible_);
    sentinel.times = {.hardware_cull_ms = to_the_microsecond(stopwatch.milliseconds()),
                      .queries = static_cast<uint32_t>(result.tests),
                      .cut_size = static_cast<uint32_t>(result.selected),
                      .sent_at_ms = to_the_microsecond(steady_milliseconds())};
    inbox_.mailbox().send(peer_, Channel::nodes, sentinel);
    inbox_.mailbox().send(Role::render, Channel::nodes, sentinel);
    ++shop_.summary.culled;
  }

  /// OR in frame i: V(i) comes in, R(i+1) is drawn from it.
  void represent(uint32_t frame) {
    const FrameRequest current = request(camera_);
    const Stopwatch waiting;
    camera_ = inbox_.camera(frame + 1);
    const double camera_waiting_ms = waiting.milliseconds();
    const double began_at_ms = steady_milliseconds();
    const Stopwatch whole;
    begin(camera_);
    IntakeResult intake = take_frame(inbox_, shop_.pack.skeleton(), shop_.pack.content_hash(), current,
                                     visible_, [&](const std::vector<DrawableId>& decided) {
                                       be_slow();
                                       shop_.stage->represent(decided);
                                     });
    be_slow();
    if (intake.digest_mismatch) {
      begin(camera_);
      shop_.stage->represent(intake.visible);
    }
    shop_.stage->finish();
    const double represent_ms = whole.milliseconds() - intake.waiting_ms;
    previous_visible_ = std::move(visible_);
    visible_ = std::move(intake.visible);
    visible_frame_ = frame;
    inbox_.mailbox().send(Role::render, Channel::nodes,
                          SwitchReport{.frame = frame,
                                       .began_at_ms = to_the_microsecond(began_at_ms),
                                       .occlusion_representation_ms = to_the_microsecond(represent_ms),
                                       .camera_waiting_ms = to_the_microsecond(camera_waiting_ms),
                                       .packets_waiting_ms = to_the_microsecond(intake.waiting_ms),
                                       .drawables = static_cast<uint32_t>(shop_.stage->represented().size()),
                                       .triangles = shop_.stage->represented_triangles()});
    ++shop_.summary.represented;
  }

  void answer(Role asking, uint32_t frame) {
    const bool current = frame == visible_frame_;
    if (!current && frame + 1 != visible_frame_) {
      throw PeerLost(asking, fmt::format("asks for the visible set of frame {}, which is long over", frame));
    }
    inbox_.mailbox().send(asking, Channel::nodes, FullSet{frame, current ? visible_ : previous_visible_});
  }

  Workshop& shop_;
  Inbox inbox_;
  Role peer_;
  CameraMessage camera_;  ///< of the frame at hand; after represent(), of the next one
  VisibleSet visible_, previous_visible_;
  uint32_t visible_frame_ = 0;
};

}  // namespace

SwitchNodeSummary run_switch_node(const Pack& pack, Role self, const SwitchNodeOptions& options) {
  Workshop workshop(pack, self, options);
  for (bool again = false;; again = true) {
    const std::unique_ptr<Mailbox> mailbox = options.connect(again);
    if (!mailbox) return workshop.summary;
    ++workshop.summary.epochs;
    try {
      Epoch(workshop, *mailbox).run();
    } catch (const SessionEnded&) {
      // The session is over for the peers too, unless it is this role alone that was told to end.
      mailbox->leave(stop_requested() ? "told to end" : "");
      if (options.on_epoch_end) options.on_epoch_end(*mailbox, "");
      return workshop.summary;
    } catch (const PeerLost& lost) {
      mailbox->leave(lost.what());
      if (options.on_epoch_end) options.on_epoch_end(*mailbox, lost.what());
    } catch (const std::exception& error) {
      mailbox->leave(error.what());
      throw;
    }
  }
}

}  // namespace triptych
