// The render node's switch nodes: found in the background, got ready, lost, and found again.
#pragma once

#include "nodes/inbox.hpp"
#include "scene/frame_state.hpp"

#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <set>
#include <string>

namespace triptych {

/// An epoch is a stretch of frames that all three roles play together. Before it both switch nodes are
/// connected, in a thread of its own, and rehearse the frame at hand; the render node draws by itself
/// meanwhile. Whatever goes wrong with either of them ends the epoch for both, and the search begins anew.
/// For one thread.
class Peers {
 public:
  /// Connects both switch nodes; returns nothing once `stop`, asked several times a second, says so. Called
  /// in another thread.
  using Connect = std::function<std::unique_ptr<Mailbox>(const std::function<bool()>& stop)>;
  /// Hears of the end of each connection.
  using OnEnd = std::function<void(const Mailbox&, const std::string& reason)>;

  /// Hears of both peers' clocks at the beginning of each epoch.
  using OnClocks = std::function<void(const std::vector<PeerClock>&)>;

  explicit Peers(Connect connect, OnEnd on_end = {}, OnClocks on_clocks = {});
  ~Peers();
  Peers(const Peers&) = delete;
  Peers& operator=(const Peers&) = delete;

  /// Looks after the search, without waiting. next: the frame at hand. True once an epoch may begin with it;
  /// then inbox() is there, and nothing was sent of the epoch yet.
  bool look(const FrameRequest& next);
  /// Waits for the first epoch. What connect throws is thrown here; SessionEnded where a signal asks to stop.
  void wait(const FrameRequest& first);

  /// The peers' messages, during an epoch; otherwise null.
  Inbox* inbox() { return inbox_ ? &*inbox_ : nullptr; }
  const Inbox* inbox() const { return inbox_ ? &*inbox_ : nullptr; }

  /// Ends the epoch because of what was thrown; the search begins anew, after a pause where peers that answer
  /// too late come again and again.
  void lose(const std::string& reason, bool too_late);
  /// Says goodbye to whoever is there. Empty: the session is over.
  void leave(const std::string& reason);

  uint64_t epochs() const { return epochs_; }

 private:
  void search(std::chrono::milliseconds pause);
  void rehearse(const FrameRequest& frame);
  /// Takes in what they say; true when both are ready.
  bool both_ready();
  void compare_clocks();
  void close(const std::string& reason);

  Connect connect_;
  OnEnd on_end_;
  OnClocks on_clocks_;
  std::atomic<bool> stop_{false};
  std::future<std::unique_ptr<Mailbox>> search_;
  std::unique_ptr<Mailbox> mailbox_;
  std::optional<Inbox> inbox_;
  std::set<Role> ready_;
  bool patient_ = true;                          ///< what keeps the peers away may pass
  std::chrono::steady_clock::time_point since_;  ///< of the rehearsal, or of the epoch
  uint32_t too_late_ = 0;                        ///< short epochs in a row that ended so
  uint64_t epochs_ = 0;
};

}  // namespace triptych
