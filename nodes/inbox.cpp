#include "nodes/inbox.hpp"

#include <algorithm>
#include <csignal>

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
  return std::get<CameraMessage>(wait([&](const Message& message) {
    const auto* camera = std::get_if<CameraMessage>(&message);
    return camera && camera->frame == frame;
  }));
}

std::variant<DeltaMessage, Sentinel> Inbox::packet(uint32_t frame) {
  const Message message = wait([&](const Message& candidate) {
    return (std::holds_alternative<DeltaMessage>(candidate) || std::holds_alternative<Sentinel>(candidate)) &&
           frame_of(candidate) == frame;
  });
  if (const auto* delta = std::get_if<DeltaMessage>(&message)) return *delta;
  return std::get<Sentinel>(message);
}

FullSet Inbox::full_set(uint32_t frame) {
  return std::get<FullSet>(wait([&](const Message& message) {
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
  for (;;) receive();
}

}  // namespace triptych
