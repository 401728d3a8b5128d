#include "nodes/inbox.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
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
    for (const int signal : {SIGTERM, SIGINT}) sigaction(signal, &action, nullptr);
    struct sigaction before {};
    sigaction(SIGHUP, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);  // nohup, otherwise
    // Whoever read what we say may be gone.
    std::signal(SIGPIPE, SIG_IGN);
    return true;
  }();
  return installed && stop_signal != 0;
}

void end_if_asked(const std::string& place) {
  if (stop_requested()) fail(place, "was told to end");
}

void Inbox::limit_waiting(std::optional<std::chrono::milliseconds> limit) {
  limit_ = limit;
  if (limit) deadline_ = std::chrono::steady_clock::now() + *limit;
}

void Inbox::receive(Role from) {
  // Short slices: a signal does not wake the sockets.
  using std::chrono::milliseconds;
  milliseconds slice(100);
  if (limit_) {
    slice = std::clamp(std::chrono::ceil<milliseconds>(deadline_ - std::chrono::steady_clock::now()),
                       milliseconds(0), slice);
  }
  std::optional<Received> received = mailbox_.receive(slice);
  if (stop_requested()) throw SessionEnded();
  if (!received) {
    if (limit_ && std::chrono::steady_clock::now() >= deadline_)
      throw PeerLost(from, fmt::format("no progress for {} ms", limit_->count()), true);
    return;
  }
  if (const auto* request = std::get_if<FullSetRequest>(&received->message); request && answer_full_set) {
    answer_full_set(received->peer, request->frame);
  } else if (const auto* asked = std::get_if<ClockRequest>(&received->message)) {
    mailbox_.send(received->peer, Channel::camera, ClockAnswer{asked->frame, steady_milliseconds()});
  } else if (const auto* bye = std::get_if<Bye>(&received->message)) {
    if (bye->reason.empty()) throw SessionEnded();
    throw PeerLost(received->peer, "left: " + bye->reason);
  } else {
    keep(std::move(*received));
  }
}

void Inbox::keep(Received received) {
  const Role peer = received.peer;
  ++kept_size_.messages;
  kept_size_.bytes += received.bytes;
  mailbox_.note_kept(kept_size_);
  kept_.push_back(std::move(received));
  if (kept_size_.messages > inbox_limit.messages || kept_size_.bytes > inbox_limit.bytes)
    throw PeerLost(peer, "sends messages that nobody waits for");
}

void Inbox::release(const Received& received) {
  --kept_size_.messages;
  kept_size_.bytes -= received.bytes;
  mailbox_.note_kept(kept_size_);
}

Message Inbox::wait(Role from, const std::function<bool(const Message&)>& wanted) {
  for (;;) {
    const auto found = std::find_if(kept_.begin(), kept_.end(),
                                    [&](const Received& received) { return wanted(received.message); });
    if (found != kept_.end()) {
      release(*found);
      Message message = std::move(found->message);
      kept_.erase(found);
      return message;
    }
    receive(from);
  }
}

CameraMessage Inbox::first_camera() {
  return std::get<CameraMessage>(wait(
      Role::render, [](const Message& message) { return std::holds_alternative<CameraMessage>(message); }));
}

CameraMessage Inbox::camera(uint32_t frame) {
  const TimelineScope scope("wait for the camera", frame);
  return std::get<CameraMessage>(wait(Role::render, [&](const Message& message) {
    const auto* camera = std::get_if<CameraMessage>(&message);
    return camera && !camera->rehearsal && camera->frame == frame;
  }));
}

std::variant<DeltaMessage, Sentinel> Inbox::packet(uint32_t frame) {
  const TimelineScope scope("wait for a packet", frame);
  const Message message = wait(hardware_cull_role(frame), [&](const Message& candidate) {
    return (std::holds_alternative<DeltaMessage>(candidate) || std::holds_alternative<Sentinel>(candidate)) &&
           frame_of(candidate) == frame;
  });
  if (const auto* delta = std::get_if<DeltaMessage>(&message)) return *delta;
  return std::get<Sentinel>(message);
}

FullSet Inbox::full_set(uint32_t frame) {
  const TimelineScope scope("wait for the full set", frame);
  return std::get<FullSet>(wait(hardware_cull_role(frame), [&](const Message& message) {
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
    const Message message = wait(peer, [&](const Message& candidate) {
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

void Inbox::wait_for_end() {
  for (;;) receive(Role::render);
}

}  // namespace triptych
