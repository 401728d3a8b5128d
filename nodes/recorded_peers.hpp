// The peers of one role, played from that role's recording, so that it can run alone.
#pragma once

#include "protocol/mailbox.hpp"
#include "protocol/memory_connection.hpp"

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace triptych {

/// Each peer sends what the role received from it in the session, as soon as the role has sent what came
/// before that. Packets of a delta are not waited for: how many there are is the role's choice. Threads of
/// their own play the peers; they sleep where there is nothing to do.
class RecordedPeers {
 public:
  /// Called in a peer's thread, one at a time, with each message: `sent` by the role or played to it.
  using Observe = std::function<void(const RecordedMessage&)>;

  /// messages: those of one epoch, in their order; place: the recording, for errors. patience: how long the
  /// role may send nothing while a peer waits for it.
  RecordedPeers(Role self, std::vector<RecordedMessage> messages, std::string place, Observe observe,
                std::chrono::milliseconds patience = std::chrono::minutes(1));
  ~RecordedPeers();
  RecordedPeers(const RecordedPeers&) = delete;
  RecordedPeers& operator=(const RecordedPeers&) = delete;

  /// The role's end; once. The peers begin to play. For the thread that the role connects in.
  std::unique_ptr<Mailbox> connect();
  /// Whether a peer could not go on: the role has to end.
  bool failed() const { return failed_; }
  /// Waits until everything was played. Error (place) where the role did not send what it sent in the
  /// session, or ended before.
  void finish();

 private:
  struct Peer;
  void play(Peer& peer);
  void end();

  Role self_;
  std::string place_;
  Observe observe_;
  std::chrono::milliseconds patience_;
  std::mutex observing_;
  std::vector<std::unique_ptr<Peer>> peers_;
  std::atomic<size_t> done_{0};
  std::atomic<bool> failed_{false}, ending_{false};
};

}  // namespace triptych
