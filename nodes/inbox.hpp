// A role's messages by what it waits for: a frame's camera, a frame's packets, the end.
#pragma once

#include "base/signals.hpp"
#include "nodes/ending.hpp"
#include "nodes/recent_sets.hpp"

#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <variant>

namespace triptych {

/// A peer's steady clock against this process's.
struct PeerClock {
  std::string peer;
  double ahead_ms = 0;        ///< what the peer's clock shows more
  double uncertainty_ms = 0;  ///< half of the shortest round trip: the truth lies within ± so much
};

/// An inbox keeps no more: at most two frames are in flight.
constexpr Backlog inbox_limit{4096, mailbox_limit.bytes};

/// Waits for one kind of message at a time and keeps the others in order. Requests for a full set and for the
/// time are answered whenever they come. Waiting ends where the session is over, where `stop` says so, and
/// with the loss of a peer that is gone, leaves alone, sends what nobody waits for without end (inbox_limit),
/// asks for a set that is long over, or keeps this role waiting beyond the time limit.
class Inbox {
 public:
  /// sets: what peers that ask for a full set are answered with; null for a role that nobody asks. stop:
  /// asked several times a second.
  explicit Inbox(Mailbox& mailbox, const RecentSets* sets = nullptr,
                 std::function<bool()> stop = stop_requested)
      : mailbox_(mailbox), sets_(sets), stop_(std::move(stop)) {}

  /// From now on all waiting together may take so long; nothing: for ever.
  void limit_waiting(std::optional<std::chrono::milliseconds> limit);

  /// The next camera that is a warm-up's, or the first of a frame.
  Awaited<CameraMessage> first_camera();
  /// The camera of the frame.
  Awaited<CameraMessage> camera(uint32_t frame);
  /// The frame's next packet or its end, from HC.
  Awaited<std::variant<DeltaMessage, Sentinel>> packet(uint32_t frame);
  /// V(frame), after it was asked for.
  Awaited<FullSet> full_set(uint32_t frame);
  /// Asks a peer for its clock a few times and believes the quickest answer (Cristian, "Probabilistic clock
  /// synchronization", 1989). The peer answers while it waits for whatever.
  Awaited<PeerClock> clock_of(Role peer);
  /// What the peer's clock shows more, as clock_of() last found; 0 before.
  double ahead_ms(Role peer) const;
  /// What a switch node reported of the frame, if that has come; forgets reports of this and earlier frames.
  std::optional<SwitchReport> report(uint32_t frame);
  /// Answers requests until something ends.
  Ending wait_for_end();

  /// Sends to a peer; what ends with it if it is gone.
  [[nodiscard]] std::optional<Ending> send(Role peer, Channel channel, const Message& message);
  Mailbox& mailbox() { return mailbox_; }

 private:
  /// Takes the first message that `wanted` accepts, which `from` owes; waits for it.
  Awaited<Message> wait(Role from, const std::function<bool(const Message&)>& wanted);
  /// One message, or a moment without any.
  std::optional<Ending> receive(Role from);
  std::optional<Ending> answer(Role asking, uint32_t frame);
  std::optional<Ending> keep(Received received);
  /// A kept message is used or dropped.
  void release(const Received& received);

  Mailbox& mailbox_;
  const RecentSets* sets_;
  std::function<bool()> stop_;
  std::deque<Received> kept_;
  Backlog kept_size_;
  std::map<Role, double> ahead_ms_;
  std::optional<std::chrono::milliseconds> limit_;
  std::chrono::steady_clock::time_point deadline_;
};

}  // namespace triptych
