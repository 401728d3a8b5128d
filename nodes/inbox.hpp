// A role's messages by what it waits for: a frame's camera, a frame's packets, the end.
#pragma once

#include "protocol/mailbox.hpp"

#include <deque>
#include <functional>
#include <optional>
#include <variant>

namespace triptych {

/// The session is over for this role: the render node left, or a signal asked to stop.
struct SessionEnded {};

/// Waits for one kind of message at a time and keeps the others in order. Requests for a full set are
/// answered whenever they come.
class Inbox {
 public:
  explicit Inbox(Mailbox& mailbox) : mailbox_(mailbox) {}

  /// Answers a peer that asks for V(frame); set by roles that can.
  std::function<void(Role peer, uint32_t frame)> answer_full_set;

  /// The camera of the frame. Throws SessionEnded where none will come.
  CameraMessage camera(uint32_t frame);
  /// The frame's next packet or its end, from HC.
  std::variant<DeltaMessage, Sentinel> packet(uint32_t frame);
  /// V(frame), after it was asked for.
  FullSet full_set(uint32_t frame);
  /// A report of a switch node that has come already.
  std::optional<SwitchReport> report();
  /// Answers requests until the session ends.
  [[noreturn]] void wait_for_end();

  Mailbox& mailbox() { return mailbox_; }

 private:
  /// Takes the first message that `wanted` accepts; waits for it. Error if a peer is lost or leaves in
  /// trouble.
  Message wait(const std::function<bool(const Message&)>& wanted);
  void receive();

  Mailbox& mailbox_;
  std::deque<Message> kept_;
};

/// Whether SIGTERM or SIGINT asked this process to end; the first call installs the handlers.
bool stop_requested();

}  // namespace triptych
