#include "nodes/frame_intake.hpp"

#include "base/clock.hpp"
#include "base/inject.hpp"
#include "protocol/digest.hpp"

namespace triptych {

IntakeResult take_frame(Inbox& inbox, const Skeleton& skeleton, uint64_t pack_hash, const FrameRequest& frame,
                        const VisibleSet& previous,
                        const std::function<void(const std::vector<DrawableId>&)>& decided) {
  IntakeResult result;
  VisibleStream stream(skeleton, eye_cell(skeleton, frame.view), previous);
  for (;;) {
    const Stopwatch waiting;
    const auto message = inbox.packet(frame.number);
    result.sentinel_wait_ms = waiting.milliseconds();
    result.waiting_ms += result.sentinel_wait_ms;
    if (const auto* sentinel = std::get_if<Sentinel>(&message)) {
      result.sentinel = *sentinel;
      break;
    }
    const auto& packet = std::get<DeltaMessage>(message);
    if (const auto fresh = stream.take({packet.watermark, packet.delta}); !fresh.empty()) decided(fresh);
  }
  const auto matches = [&](const VisibleSet& visible) {
    return frame_digest(frame.number, frame.view, frame.pixel_error, pack_hash, visible) == result.sentinel.digest;
  };
  result.visible = stream.visible();
  if (injected(Fault::no_digest) || matches(result.visible)) return result;
  result.digest_mismatch = true;
  inbox.mailbox().send(hardware_cull_role(frame.number), Channel::nodes, FullSetRequest{frame.number});
  result.visible = inbox.full_set(frame.number).visible;
  if (!matches(result.visible)) {
    fail(fmt::format("frame {}", frame.number), "the full visible set of {} does not match its digest either",
         role_name(hardware_cull_role(frame.number)));
  }
  return result;
}

}  // namespace triptych
