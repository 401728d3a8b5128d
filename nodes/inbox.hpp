// A role's messages by what it waits for: a frame's camera, a frame's packets, the end.
#pragma once

#include "protocol/mailbox.hpp"

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <variant>

namespace triptych {

/// The session is over for this role: the render node left, or a signal asked to stop.
struct SessionEnded {};

/// A peer's steady clock against this process's.
struct PeerClock {
  std::string peer;
  double ahead_ms = 0;        ///< what the peer's clock shows more
  double uncertainty_ms = 0;  ///< half of the shortest round trip: the truth lies within ± so much
};

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
  /// Asks a peer for its clock a few times and believes the quickest answer (Cristian, "Probabilistic clock
  /// synchronization", 1989). The peer answers while it waits for whatever.
  PeerClock clock_of(Role peer);
  /// A report of a switch node that has come already.
  std::optional<SwitchReport> report();
  /// Answers requests until the session ends.
  [[noreturn]] void wait_for_end();

  /// What the peer's clock shows more, as clock_of() last found; 0 before.
  double ahead_ms(Role peer) const;

  Mailbox& mailbox() { return mailbox_; }

 private:
  /// Takes the first message that `wanted` accepts; waits for it. Error if a peer is lost or leaves in
  /// trouble.
  Message wait(const std::function<bool(const Message&)>& wanted);
  void receive();

  Mailbox& mailbox_;
  std::deque<Message> kept_;
  std::map<Role, double> ahead_ms_;
};

/// Whether SIGTERM or SIGINT asked this process to end; the first call installs the handlers.
bool stop_requested();

}  // namespace triptych
