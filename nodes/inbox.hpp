// A role's messages, sorted by what it waits for: a frame's camera, a frame's packets, the end.
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
  double ahead_ms = 0;        ///< by how much the peer's clock is ahead
  double uncertainty_ms = 0;  ///< half of the shortest round trip: the true value lies within ± this
};

/// The most that an inbox keeps. It needs little, since at most two frames are in flight.
constexpr Backlog inbox_limit{4096, mailbox_limit.bytes};

/// Waits for one kind of message at a time and keeps the others in order. Requests for a full set and for the
/// time are answered whenever they come. Waiting ends where the session is over, where `stop` says so, and
/// with the loss of a peer: it is gone, leaves by itself, sends more than inbox_limit of messages that are
/// not waited for, requests a set that is no longer kept, or keeps this role waiting beyond the time limit.
class Inbox {
 public:
  /// sets: the answers to peers that request a full set; null for a role that is never asked. stop:
  /// asked several times a second.
  explicit Inbox(Mailbox& mailbox, const RecentSets* sets = nullptr,
                 std::function<bool()> stop = stop_requested)
      : mailbox_(mailbox), sets_(sets), stop_(std::move(stop)) {}

  /// From now on all waiting together may take this long; nullopt: without limit.
  void limit_waiting(std::optional<std::chrono::milliseconds> limit);

  /// The next camera, of a warm-up or of the epoch's first frame.
  Awaited<CameraMessage> first_camera();
  /// The camera of the frame.
  Awaited<CameraMessage> camera(uint32_t frame);
  /// The frame's next packet or its end, from HC.
  Awaited<std::variant<DeltaMessage, Sentinel>> packet(uint32_t frame);
  /// V(frame), after it was requested.
  Awaited<FullSet> full_set(uint32_t frame);
  /// Asks a peer for its clock a few times and takes the quickest answer (Cristian, "Probabilistic clock
  /// synchronization", 1989). The peer answers whatever it is waiting for.
  Awaited<PeerClock> clock_of(Role peer);
  /// By how much the peer's clock is ahead, as clock_of() last found; 0 before.
  double ahead_ms(Role peer) const;
  /// What a switch node reported of the frame, if that has come; drops reports of this and earlier frames.
  std::optional<SwitchReport> report(uint32_t frame);
  /// The sets of hidden objects that came since the last call, in their order.
  std::vector<HiddenSet> hidden_sets();
  /// Answers requests until something ends.
  Ending wait_for_end();
  /// Takes what has come, without waiting: a role that has nothing to wait for notices so who is lost.
  std::optional<Ending> tend();

  /// Sends to a peer; returns the ending if the peer is gone.
  [[nodiscard]] std::optional<Ending> send(Role peer, Channel channel, const Message& message);
  Mailbox& mailbox() { return mailbox_; }

 private:
  /// Waits for the first message that `wanted` accepts; `from` is the peer that is expected to send it.
  Awaited<Message> wait(Role from, const std::function<bool(const Message&)>& wanted);
  /// Receives one message, or none within a short time.
  std::optional<Ending> receive(Role from);
  std::optional<Ending> take(Delivery delivery);
  std::optional<Ending> answer(Role asking, uint32_t frame);
  std::optional<Ending> keep(Received received);
  /// Counts a kept message as used or dropped.
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
