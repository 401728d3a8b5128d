#include "nodes/switch_node.hpp"

#include "base/clock.hpp"
#include "base/inject.hpp"
#include "nodes/frame_intake.hpp"
#include "protocol/delta_codec.hpp"
#include "protocol/digest.hpp"

#include <optional>

namespace triptych {

namespace {

class SwitchNode {
 public:
  SwitchNode(const Pack& pack, Mailbox& mailbox, Role self, const SwitchNodeOptions& options)
      : pack_(pack),
        inbox_(mailbox),
        self_(self),
        peer_(self == Role::switch_0 ? Role::switch_1 : Role::switch_0),
        options_(options),
        renderer_(pack) {
    inbox_.answer_full_set = [this](Role asking, uint32_t frame) { answer(asking, frame); };
  }

  void run() {
    camera_ = inbox_.camera(0);
    for (uint32_t frame = 0;; ++frame) {
      if (hardware_cull_role(frame) == self_) {
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
    return {camera.frame, camera.view, camera.pixel_error};
  }

  void begin(const CameraMessage& camera) {
    if (!stage_ || stage_width_ != camera.view.width || stage_height_ != camera.view.height) {
      stage_width_ = camera.view.width;
      stage_height_ = camera.view.height;
      stage_.emplace(renderer_, stage_width_, stage_height_, options_.test);
    }
    stage_->begin(request(camera));
  }

  /// HC in frame i: R(i) stands, V(i−1) is known.
  void cull(uint32_t frame) {
    if (frame == 0) begin(camera_);
    const Stopwatch stopwatch;
    Sentinel sentinel{.frame = frame, .visible = 0, .added = 0, .removed = 0, .digest = 0, .times = {}};
    const CullResult result = stage_->cull(visible_, options_.cull, [&](CullPacket packet) {
      sentinel.added += static_cast<uint32_t>(packet.delta.added.size());
      sentinel.removed += static_cast<uint32_t>(packet.delta.removed.size());
      if (injected(Fault::wrong_delta) && !packet.delta.added.empty()) packet.delta.added.pop_back();
      const DeltaMessage message{frame, packet.watermark, encode_delta(packet.delta, visible_)};
      inbox_.mailbox().send(peer_, Channel::nodes, message);
      inbox_.mailbox().send(Role::render, Channel::nodes, message);
    });
    previous_visible_ = std::move(visible_);
    visible_ = result.visible;
    visible_frame_ = frame;
    sentinel.visible = static_cast<uint32_t>(visible_.size());
    sentinel.digest = frame_digest(frame, camera_.view, camera_.pixel_error, pack_.content_hash(), visible_);
    sentinel.times = {.hardware_cull_ms = stopwatch.milliseconds(),
                      .occlusion_representation_ms = represent_ms_,
                      .waiting_ms = waiting_ms_,
                      .queries = static_cast<uint32_t>(result.tests),
                      .cut_size = static_cast<uint32_t>(stage_->cut().drawables.size()),
                      .sent_at_ms = steady_milliseconds()};
    inbox_.mailbox().send(peer_, Channel::nodes, sentinel);
    inbox_.mailbox().send(Role::render, Channel::nodes, sentinel);
  }

  /// OR in frame i: V(i) comes in, R(i+1) is drawn from it.
  void represent(uint32_t frame) {
    const FrameRequest current = request(camera_);
    const Stopwatch waiting;
    camera_ = inbox_.camera(frame + 1);
    waiting_ms_ = waiting.milliseconds();
    const Stopwatch whole;
    begin(camera_);
    IntakeResult intake =
        take_frame(inbox_, pack_.skeleton(), pack_.content_hash(), current, visible_,
                   [&](const std::vector<DrawableId>& decided) { stage_->represent(decided); });
    if (intake.digest_mismatch) {
      begin(camera_);
      stage_->represent(intake.visible);
    }
    stage_->finish();
    represent_ms_ = whole.milliseconds() - intake.waiting_ms;
    waiting_ms_ += intake.waiting_ms;
    previous_visible_ = std::move(visible_);
    visible_ = std::move(intake.visible);
    visible_frame_ = frame;
    inbox_.mailbox().send(Role::render, Channel::nodes,
                          SwitchReport{.frame = frame,
                                       .occlusion_representation_ms = represent_ms_,
                                       .waiting_ms = waiting_ms_,
                                       .drawables = static_cast<uint32_t>(stage_->represented().size()),
                                       .triangles = stage_->represented_triangles()});
  }

  void answer(Role asking, uint32_t frame) {
    const bool current = frame == visible_frame_;
    if (!current && frame + 1 != visible_frame_) {
      fail(role_name(asking), "asks for the visible set of frame {}, which is long over", frame);
    }
    inbox_.mailbox().send(asking, Channel::nodes, FullSet{frame, current ? visible_ : previous_visible_});
  }

  const Pack& pack_;
  Inbox inbox_;
  Role self_, peer_;
  SwitchNodeOptions options_;
  Renderer renderer_;
  std::optional<OcclusionStage> stage_;
  int stage_width_ = 0, stage_height_ = 0;
  CameraMessage camera_;  ///< of the frame at hand; after represent(), of the next one
  VisibleSet visible_, previous_visible_;
  uint32_t visible_frame_ = 0;
  double represent_ms_ = 0, waiting_ms_ = 0;
};

}  // namespace

void run_switch_node(const Pack& pack, Mailbox& mailbox, Role self, const SwitchNodeOptions& options) {
  try {
    SwitchNode(pack, mailbox, self, options).run();
  } catch (const SessionEnded&) {
    mailbox.leave("");
  } catch (const PeerLost&) {
    mailbox.leave("");
    throw;
  } catch (const std::exception& error) {
    mailbox.leave(error.what());
    throw;
  }
}

}  // namespace triptych
