#include "nodes/inbox.hpp"

#include <algorithm>
#include <csignal>

namespace triptych {

namespace {

volatile std::sig_atomic_t stop_signal = 0;
void note_signal(int signal) { stop_signal = signal; }

/// No role keeps more: at most two frames are in flight.
constexpr size_t most_kept = 4096;

}  // namespace

bool stop_requested() {
  static const bool installed = [] {
    struct sigaction action {};
    action.sa_handler = note_signal;
    for (const int signal : {SIGTERM, SIGINT, SIGHUP}) sigaction(signal, &action, nullptr);
    // Whoever read what we say may be gone.
    std::signal(SIGPIPE, SIG_IGN);
    return true;
  }();
  return installed && stop_signal != 0;
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
  } else if (const auto* bye = std::get_if<Bye>(&received->message)) {
    if (bye->reason.empty()) throw SessionEnded();
    throw PeerLost(received->peer, "left: " + bye->reason);
  } else {
    if (kept_.size() == most_kept) throw PeerLost(received->peer, "sends messages that nobody waits for");
    kept_.push_back(std::move(received->message));
  }
}

Message Inbox::wait(Role from, const std::function<bool(const Message&)>& wanted) {
  for (;;) {
    if (const auto found = std::find_if(kept_.begin(), kept_.end(), wanted); found != kept_.end()) {
      Message message = std::move(*found);
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
  return std::get<CameraMessage>(wait(Role::render, [&](const Message& message) {
    const auto* camera = std::get_if<CameraMessage>(&message);
    return camera && !camera->rehearsal && camera->frame == frame;
  }));
}

std::variant<DeltaMessage, Sentinel> Inbox::packet(uint32_t frame) {
  const Message message = wait(hardware_cull_role(frame), [&](const Message& candidate) {
    return (std::holds_alternative<DeltaMessage>(candidate) || std::holds_alternative<Sentinel>(candidate)) &&
           frame_of(candidate) == frame;
  });
  if (const auto* delta = std::get_if<DeltaMessage>(&message)) return *delta;
  return std::get<Sentinel>(message);
}

FullSet Inbox::full_set(uint32_t frame) {
  return std::get<FullSet>(wait(hardware_cull_role(frame), [&](const Message& message) {
    const auto* set = std::get_if<FullSet>(&message);
    return set && set->frame == frame;
  }));
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
  for (;;) receive(Role::render);
}

}  // namespace triptych
