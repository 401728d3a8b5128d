#include "nodes/recorded_peers.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"

#include <chrono>
#include <map>
#include <utility>

namespace triptych {

namespace {

constexpr std::chrono::milliseconds look_again{50};
constexpr size_t wire_capacity = size_t{1} << 20;

bool is_end(const Message& message) {
  return std::holds_alternative<Hello>(message) || std::holds_alternative<Bye>(message);
}

bool is_waited_for(const Message& message) { return !std::holds_alternative<DeltaMessage>(message); }

}  // namespace

struct RecordedPeers::Peer {
  Role role;
  std::vector<RecordedMessage> messages;  ///< between it and the role
  std::map<Channel, MemoryWire> wires;
  size_t came = 0;  ///< from the role, of those that are waited for
  std::exception_ptr problem;
  std::thread thread;
};

RecordedPeers::RecordedPeers(Role self, std::vector<RecordedMessage> messages, std::string place,
                             Observe observe, std::chrono::milliseconds patience)
    : self_(self), place_(std::move(place)), observe_(std::move(observe)), patience_(patience) {
  for (const Role role : all_roles) {
    if (role == self) continue;
    auto peer = std::make_unique<Peer>(Peer{role, {}, {}, 0, {}, {}});
    for (const RecordedMessage& message : messages) {
      if (message.peer != role || is_end(message.message)) continue;
      peer->messages.push_back(message);
      peer->wires.try_emplace(message.channel, wire_capacity);
    }
    if (peer->messages.empty()) fail(place_, "holds no message from {}", role_name(role));
    peers_.push_back(std::move(peer));
  }
}

RecordedPeers::~RecordedPeers() { end(); }

std::unique_ptr<Mailbox> RecordedPeers::connect() {
  auto mailbox = std::make_unique<Mailbox>();
  for (const auto& peer : peers_) {
    for (const auto& [channel, wire] : peer->wires)
      mailbox->add(peer->role, channel,
                   wire.take(MemoryWire::End::caller, mailbox->context(), role_name(peer->role)));
  }
  for (const auto& peer : peers_) {
    peer->thread = std::thread([this, &peer = *peer] {
      try {
        play(peer);
      } catch (...) {
        peer.problem = std::current_exception();
        failed_ = true;
      }
    });
  }
  return mailbox;
}

void RecordedPeers::play(Peer& peer) {
  Mailbox mailbox;
  for (const auto& [channel, wire] : peer.wires)
    mailbox.add(self_, channel, wire.take(MemoryWire::End::callee, mailbox.context(), role_name(self_)));
  const auto tell = [&](const RecordedMessage& message) {
    const std::lock_guard lock(observing_);
    observe_(message);
  };
  size_t expected = 0;
  const auto wait = [&] {
    const Stopwatch silence;
    while (peer.came < expected) {
      const bool ending = ending_;
      const std::optional<Delivery> delivery = mailbox.receive(look_again);
      if (!delivery && (ending || failed_)) fail(place_, "the role ended before the session did");
      if (!delivery && silence.milliseconds() > static_cast<double>(patience_.count()))
        fail(place_, "the role sends nothing to {} any more", role_name(peer.role));
      if (!delivery) continue;
      const auto* received = std::get_if<Received>(&*delivery);
      if (received == nullptr) fail(place_, "the role was lost: {}", std::get<PeerLost>(*delivery).reason);
      tell({0, true, peer.role, received->channel, received->message});
      peer.came += is_waited_for(received->message);
    }
  };
  for (const RecordedMessage& message : peer.messages) {
    if (message.sent) {
      expected += is_waited_for(message.message);
      continue;
    }
    wait();
    tell({0, false, peer.role, message.channel, message.message});
    if (const auto lost = mailbox.send(self_, message.channel, message.message))
      fail(place_, "the role was lost: {}", lost->reason);
  }
  wait();
  // The first Bye is the end of the session: the render node's, and no switch node's.
  ++done_;
  while ((self_ == Role::render || done_ < peers_.size()) && !failed_ && !ending_)
    static_cast<void>(mailbox.receive(look_again));
  mailbox.leave("");
}

void RecordedPeers::end() {
  ending_ = true;
  for (const auto& peer : peers_) {
    if (peer->thread.joinable()) peer->thread.join();
  }
}

void RecordedPeers::finish() {
  end();
  for (const auto& peer : peers_) {
    if (peer->problem) std::rethrow_exception(peer->problem);
  }
}

}  // namespace triptych
