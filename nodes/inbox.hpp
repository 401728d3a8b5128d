// A role's messages by what it waits for: a frame's camera, a frame's packets, the end.
#pragma once

#include "protocol/mailbox.hpp"

#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <variant>

namespace triptych {

/// The session is over for this role: a peer said so, or a signal asked to stop.
struct SessionEnded {};

/// A peer's steady clock against this process's.
struct PeerClock {
  std::string peer;
  double ahead_ms = 0;        ///< what the peer's clock shows more
  double uncertainty_ms = 0;  ///< half of the shortest round trip: the truth lies within ± so much
};

/// An inbox keeps no more: at most two frames are in flight.
constexpr Waiting inbox_limit{4096, mailbox_limit.bytes};

/// Waits for one kind of message at a time and keeps the others in order. Requests for a full set are
/// answered whenever they come. Throws SessionEnded at the end, and PeerLost for a peer that is gone, leaves
/// alone, sends what nobody waits for without end (inbox_limit), or keeps this role waiting beyond the time
/// limit.
class Inbox {
 public:
  explicit Inbox(Mailbox& mailbox) : mailbox_(mailbox) {}

  /// Answers a peer that asks for V(frame); set by roles that can.
  std::function<void(Role peer, uint32_t frame)> answer_full_set;

  /// From now on all waiting together may take so long; nothing: for ever.
  void limit_waiting(std::optional<std::chrono::milliseconds> limit);

  /// The next camera that is a rehearsal's, or the first of a frame.
  CameraMessage first_camera();
  /// The camera of the frame.
  CameraMessage camera(uint32_t frame);
  /// The frame's next packet or its end, from HC.
  std::variant<DeltaMessage, Sentinel> packet(uint32_t frame);
  /// V(frame), after it was asked for.
  FullSet full_set(uint32_t frame);
  /// Asks a peer for its clock a few times and believes the quickest answer (Cristian, "Probabilistic clock
  /// synchronization", 1989). The peer answers while it waits for whatever.
  PeerClock clock_of(Role peer);
  /// What the peer's clock shows more, as clock_of() last found; 0 before.
  double ahead_ms(Role peer) const;
  /// What a switch node reported of the frame, if that has come; forgets reports of this and earlier frames.
  std::optional<SwitchReport> report(uint32_t frame);
  /// Answers requests until the session ends.
  [[noreturn]] void wait_for_end();

  Mailbox& mailbox() { return mailbox_; }

 private:
  /// Takes the first message that `wanted` accepts, which `from` owes; waits for it.
  Message wait(Role from, const std::function<bool(const Message&)>& wanted);
  void receive(Role from);
  void keep(Received received);
  /// A kept message is used or dropped.
  void release(const Received& received);

  Mailbox& mailbox_;
  std::deque<Received> kept_;
  Waiting kept_size_;
  std::map<Role, double> ahead_ms_;
  std::optional<std::chrono::milliseconds> limit_;
  std::chrono::steady_clock::time_point deadline_;
};

/// Whether SIGTERM, SIGINT or SIGHUP (unless that is ignored, as by nohup) asked this process to end; the
/// first call installs the handlers.
bool stop_requested();
/// Error (place) where that was asked: for work between two things that can be left as they are.
void end_if_asked(const std::string& place);

}  // namespace triptych
