#include "nodes/frame_intake.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "protocol/delta_codec.hpp"
#include "protocol/digest.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// The packet's changes of V(i−1); none where they do not fit the set that this role has: then the digest
/// will not match.
VisibleDelta delta_of(const DeltaMessage& packet, const VisibleSet& previous) {
  try {
    return decode_delta(packet.encoded, previous, "delta");
  } catch (const Error&) {
    return {};
  }
}

}  // namespace

Awaited<IntakeResult> take_frame(Inbox& inbox, const Skeleton& skeleton, uint64_t pack_hash,
                                 const FrameRequest& frame, const VisibleSet& previous,
                                 const std::function<void(const std::vector<DrawableId>&)>& decided,
                                 const SessionRules& rules) {
  const Role sender = hardware_cull_role(frame.number);
  IntakeResult result;
  VisibleStream stream(skeleton, frame.state, previous);
  for (;;) {
    const double began_ms = steady_milliseconds();
    const auto message = inbox.packet(frame.number);
    if (!message) return message.ending();
    const double came_ms = steady_milliseconds();
    result.waiting_ms += came_ms - began_ms;
    if (const auto* sentinel = std::get_if<Sentinel>(&*message)) {
      result.sent_ms = sentinel->times.sent_at_ms - inbox.ahead_ms(sender);
      result.network_ms = std::clamp(came_ms - result.sent_ms, 0.0, came_ms - began_ms);
      result.sentinel = *sentinel;
      break;
    }
    const auto& packet = std::get<DeltaMessage>(*message);
    if (const auto fresh = stream.take({packet.watermark, delta_of(packet, previous)}); !fresh.empty())
      decided(fresh);
  }
  const auto matches = [&](const VisibleSet& visible) {
    return frame_digest(frame.number, frame.state, pack_hash, visible) == result.sentinel.digest;
  };
  result.visible = stream.visible();
  if (!rules.compares_digests || matches(result.visible)) return result;
  result.digest_mismatch = true;
  if (auto ending = inbox.send(sender, Channel::nodes, FullSetRequest{frame.number}))
    return std::move(*ending);
  auto full = inbox.full_set(frame.number);
  if (!full) return full.ending();
  result.visible = std::move(full->visible);
  if (matches(result.visible)) return result;
  return ending_of_lost(
      sender, fmt::format("frame {}: the full visible set does not match its digest either", frame.number));
}

}  // namespace triptych
