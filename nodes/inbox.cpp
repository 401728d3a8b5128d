#include "nodes/inbox.hpp"

#include "base/clock.hpp"
#include "base/timeline.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <limits>

namespace triptych {

void Inbox::limit_waiting(std::optional<std::chrono::milliseconds> limit) {
  limit_ = limit;
  if (limit) deadline_ = std::chrono::steady_clock::now() + *limit;
}

std::optional<Ending> Inbox::send(Role peer, Channel channel, const Message& message) {
  if (auto lost = mailbox_.send(peer, channel, message)) return ending_of(std::move(*lost));
  return std::nullopt;
}

std::optional<Ending> Inbox::receive(Role from) {
  // In short slices, since a signal does not wake the connections.
  using std::chrono::milliseconds;
  milliseconds slice(100);
  if (limit_) {
    slice = std::clamp(std::chrono::ceil<milliseconds>(deadline_ - std::chrono::steady_clock::now()),
                       milliseconds(0), slice);
  }
  std::optional<Delivery> delivery = mailbox_.receive(slice);
  if (stop_()) return Ending{.cause = Ending::Cause::stopped};
  if (!delivery) {
    if (!limit_ || std::chrono::steady_clock::now() < deadline_) return std::nullopt;
    Ending late = ending_of_lost(from, fmt::format("no progress for {} ms", limit_->count()));
    late.too_late = true;
    return late;
  }
  return take(std::move(*delivery));
}

std::optional<Ending> Inbox::tend() {
  while (auto delivery = mailbox_.receive(std::chrono::milliseconds(0))) {
    if (auto ending = take(std::move(*delivery))) return ending;
  }
  return std::nullopt;
}

std::optional<Ending> Inbox::take(Delivery delivery) {
  if (auto* lost = std::get_if<PeerLost>(&delivery)) return ending_of(std::move(*lost));
  auto& received = std::get<Received>(delivery);
  if (const auto* request = std::get_if<FullSetRequest>(&received.message); request && sets_)
    return answer(received.peer, request->frame);
  if (const auto* asked = std::get_if<ClockRequest>(&received.message))
    return send(received.peer, Channel::camera, ClockAnswer{asked->frame, steady_milliseconds()});
  if (const auto* bye = std::get_if<Bye>(&received.message)) {
    if (bye->reason.empty()) return Ending{.cause = Ending::Cause::session_over};
    return ending_of_lost(received.peer, "left: " + bye->reason);
  }
  return keep(std::move(received));
}

std::optional<Ending> Inbox::answer(Role asking, uint32_t frame) {
  if (const VisibleSet* set = sets_->of(frame)) return send(asking, Channel::nodes, FullSet{frame, *set});
  return ending_of_lost(asking,
                        fmt::format("asks for the visible set of frame {}, which is long over", frame));
}

std::optional<Ending> Inbox::keep(Received received) {
  const Role peer = received.peer;
  ++kept_size_.messages;
  kept_size_.bytes += received.bytes;
  mailbox_.note_kept(kept_size_);
  kept_.push_back(std::move(received));
  if (kept_size_.messages > inbox_limit.messages || kept_size_.bytes > inbox_limit.bytes)
    return ending_of_lost(peer, "sends messages that nobody waits for");
  return std::nullopt;
}

void Inbox::release(const Received& received) {
  --kept_size_.messages;
  kept_size_.bytes -= received.bytes;
  mailbox_.note_kept(kept_size_);
}

Awaited<Message> Inbox::wait(Role from, const std::function<bool(const Message&)>& wanted) {
  for (;;) {
    const auto found = std::find_if(kept_.begin(), kept_.end(),
                                    [&](const Received& received) { return wanted(received.message); });
    if (found != kept_.end()) {
      release(*found);
      Message message = std::move(found->message);
      kept_.erase(found);
      return message;
    }
    if (auto ending = receive(from)) return std::move(*ending);
  }
}

Awaited<CameraMessage> Inbox::first_camera() {
  auto message = wait(Role::render, [](const Message& candidate) {
    return std::holds_alternative<CameraMessage>(candidate);
  });
  if (!message) return message.ending();
  return std::get<CameraMessage>(std::move(*message));
}

Awaited<CameraMessage> Inbox::camera(uint32_t frame) {
  const TimelineScope scope("wait for the camera", frame);
  auto message = wait(Role::render, [&](const Message& candidate) {
    const auto* camera = std::get_if<CameraMessage>(&candidate);
    return camera && !camera->warm_up && camera->frame == frame;
  });
  if (!message) return message.ending();
  return std::get<CameraMessage>(std::move(*message));
}

Awaited<std::variant<DeltaMessage, Sentinel>> Inbox::packet(uint32_t frame) {
  const TimelineScope scope("wait for a packet", frame);
  auto message = wait(hardware_cull_role(frame), [&](const Message& candidate) {
    return (std::holds_alternative<DeltaMessage>(candidate) || std::holds_alternative<Sentinel>(candidate)) &&
           frame_of(candidate) == frame;
  });
  using Packet = std::variant<DeltaMessage, Sentinel>;
  if (!message) return message.ending();
  if (auto* delta = std::get_if<DeltaMessage>(&*message)) return Packet(std::move(*delta));
  return Packet(std::get<Sentinel>(*message));
}

Awaited<FullSet> Inbox::full_set(uint32_t frame) {
  const TimelineScope scope("wait for the full set", frame);
  auto message = wait(hardware_cull_role(frame), [&](const Message& candidate) {
    const auto* set = std::get_if<FullSet>(&candidate);
    return set && set->frame == frame;
  });
  if (!message) return message.ending();
  return std::get<FullSet>(std::move(*message));
}

Awaited<PeerClock> Inbox::clock_of(Role peer) {
  constexpr uint32_t rounds = 8;
  PeerClock clock{role_name(peer), 0, std::numeric_limits<double>::infinity()};
  for (uint32_t round = 0; round < rounds; ++round) {
    const double asked_ms = steady_milliseconds();
    if (auto ending = send(peer, Channel::camera, ClockRequest{round})) return std::move(*ending);
    const auto message = wait(peer, [&](const Message& candidate) {
      const auto* answer = std::get_if<ClockAnswer>(&candidate);
      return answer && answer->frame == round;
    });
    if (!message) return message.ending();
    const double came_ms = steady_milliseconds();
    const double half_trip_ms = (came_ms - asked_ms) / 2;
    if (half_trip_ms >= clock.uncertainty_ms) continue;
    clock.ahead_ms = std::get<ClockAnswer>(*message).clock_ms - (asked_ms + half_trip_ms);
    clock.uncertainty_ms = half_trip_ms;
  }
  ahead_ms_[peer] = clock.ahead_ms;
  return clock;
}

double Inbox::ahead_ms(Role peer) const {
  const auto found = ahead_ms_.find(peer);
  return found == ahead_ms_.end() ? 0 : found->second;
}

std::optional<SwitchReport> Inbox::report(uint32_t frame) {
  std::optional<SwitchReport> found;
  std::erase_if(kept_, [&](const Received& received) {
    const auto* report = std::get_if<SwitchReport>(&received.message);
    if (!report || report->frame > frame) return false;
    if (report->frame == frame) found = *report;
    release(received);
    return true;
  });
  return found;
}

std::vector<HiddenSet> Inbox::hidden_sets() {
  std::vector<HiddenSet> sets;
  std::erase_if(kept_, [&](Received& received) {
    auto* set = std::get_if<HiddenSet>(&received.message);
    if (!set) return false;
    sets.push_back(std::move(*set));
    release(received);
    return true;
  });
  return sets;
}

Ending Inbox::wait_for_end() {
  for (;;) {
    if (auto ending = receive(Role::render)) return std::move(*ending);
  }
}

}  // namespace triptych
