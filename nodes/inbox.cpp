#include "nodes/inbox.hpp"

#include "base/clock.hpp"
#include "base/timeline.hpp"

#include <algorithm>
#include <csignal>
#include <limits>

namespace triptych {

namespace {
volatile std::sig_atomic_t stop_signal = 0;
void note_signal(int signal) { stop_signal = signal; }
}  // namespace

bool stop_requested() {
  static const bool installed = [] {
    struct sigaction action {};
    action.sa_handler = note_signal;
    sigaction(SIGTERM, &action, nullptr);
    sigaction(SIGINT, &action, nullptr);
    return true;
  }();
  return installed && stop_signal != 0;
}

void Inbox::receive() {
  // Short slices: a signal does not wake the sockets.
  constexpr std::chrono::milliseconds slice(100);
  std::optional<Received> received = mailbox_.receive(slice);
  if (stop_requested()) throw SessionEnded();
  if (!received) return;
  if (const auto* request = std::get_if<FullSetRequest>(&received->message); request && answer_full_set) {
    answer_full_set(received->peer, request->frame);
  } else if (const auto* asked = std::get_if<ClockRequest>(&received->message)) {
    mailbox_.send(received->peer, Channel::camera, ClockAnswer{asked->frame, steady_milliseconds()});
  } else if (const auto* bye = std::get_if<Bye>(&received->message)) {
    if (bye->reason.empty()) throw SessionEnded();
    fail(role_name(received->peer), "left: {}", bye->reason);
  } else {
    kept_.push_back(std::move(received->message));
  }
}

Message Inbox::wait(const std::function<bool(const Message&)>& wanted) {
  for (;;) {
    if (const auto found = std::find_if(kept_.begin(), kept_.end(), wanted); found != kept_.end()) {
      Message message = std::move(*found);
      kept_.erase(found);
      return message;
    }
    receive();
  }
}

CameraMessage Inbox::camera(uint32_t frame) {
  const TimelineScope scope("wait for the camera", frame);
  return std::get<CameraMessage>(wait([&](const Message& message) {
    const auto* camera = std::get_if<CameraMessage>(&message);
    return camera && camera->frame == frame;
  }));
}

std::variant<DeltaMessage, Sentinel> Inbox::packet(uint32_t frame) {
  const TimelineScope scope("wait for a packet", frame);
  const Message message = wait([&](const Message& candidate) {
    return (std::holds_alternative<DeltaMessage>(candidate) || std::holds_alternative<Sentinel>(candidate)) &&
           frame_of(candidate) == frame;
  });
  if (const auto* delta = std::get_if<DeltaMessage>(&message)) return *delta;
  return std::get<Sentinel>(message);
}

FullSet Inbox::full_set(uint32_t frame) {
  const TimelineScope scope("wait for the full set", frame);
  return std::get<FullSet>(wait([&](const Message& message) {
    const auto* set = std::get_if<FullSet>(&message);
    return set && set->frame == frame;
  }));
}

PeerClock Inbox::clock_of(Role peer) {
  constexpr uint32_t rounds = 8;
  PeerClock clock{role_name(peer), 0, std::numeric_limits<double>::infinity()};
  for (uint32_t round = 0; round < rounds; ++round) {
    const double asked_ms = steady_milliseconds();
    mailbox_.send(peer, Channel::camera, ClockRequest{round});
    const Message message = wait([&](const Message& candidate) {
      const auto* answer = std::get_if<ClockAnswer>(&candidate);
      return answer && answer->frame == round;
    });
    const double came_ms = steady_milliseconds();
    const double half_trip_ms = (came_ms - asked_ms) / 2;
    if (half_trip_ms >= clock.uncertainty_ms) continue;
    clock.ahead_ms = std::get<ClockAnswer>(message).clock_ms - (asked_ms + half_trip_ms);
    clock.uncertainty_ms = half_trip_ms;
  }
  ahead_ms_[peer] = clock.ahead_ms;
  return clock;
}

double Inbox::ahead_ms(Role peer) const {
  const auto found = ahead_ms_.find(peer);
  return found == ahead_ms_.end() ? 0 : found->second;
}

std::optional<SwitchReport> Inbox::report() {
  const auto found = std::find_if(kept_.begin(), kept_.end(),
                                  [](const Message& m) { return std::holds_alternative<SwitchReport>(m); });
  if (found == kept_.end()) return std::nullopt;
  const SwitchReport report = std::get<SwitchReport>(*found);
  kept_.erase(found);
  return report;
}

void Inbox::wait_for_end() {
  for (;;) receive();
}

}  // namespace triptych
