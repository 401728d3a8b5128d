// The render node's switch nodes: found in the background, warmed up, lost, and found again.
#pragma once

#include "nodes/frame_source.hpp"
#include "nodes/inbox.hpp"

#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <set>
#include <string>

namespace triptych {

/// An epoch is a stretch of frames that all three roles draw together. Before it both switch nodes are
/// connected, in a thread of its own, and warm up with the current frame; the render node draws by itself
/// meanwhile, for as long as that takes. A failure of either of them ends the epoch for both, and the search
/// begins anew. Nothing that a switch node does or leaves undone is an error here. For one thread.
class Peers {
 public:
  /// Connects both switch nodes; returns nothing once `stop`, asked several times a second, says so. Called
  /// in another thread, again and again where it returns nothing before that, or throws: the reason is said
  /// on standard error, once for as long as it stays the same.
  using Connect = std::function<std::unique_ptr<Mailbox>(const std::function<bool()>& stop)>;

  /// sink: is told of clocks and of the end of each epoch. stop: whether this process is to end.
  Peers(Connect connect, FrameSink& sink, std::function<bool()> stop);
  ~Peers();
  Peers(const Peers&) = delete;
  Peers& operator=(const Peers&) = delete;

  /// Checks on the search, without waiting. next: the frame to draw next. True once an epoch may begin with
  /// it; then inbox() is not null, and nothing of the epoch has been sent yet. Where the warm-up fails: why;
  /// the search has begun anew then.
  Awaited<bool> look(const FrameRequest& next);
  /// How long a frame may take; warm-ups, which draw several and read their geometry, may take far longer.
  void expect_frames_of(std::chrono::milliseconds limit) { frame_limit_ = limit; }

  /// To both of them, during an epoch: the camera, and before it what is hidden in it, unless that was sent
  /// last.
  [[nodiscard]] std::optional<Ending> send(const CameraMessage& camera);

  /// The peers' messages, during an epoch; otherwise null.
  Inbox* inbox() { return inbox_ ? &*inbox_ : nullptr; }
  const Inbox* inbox() const { return inbox_ ? &*inbox_ : nullptr; }

  /// Ends the epoch; the search begins anew, after a pause if several in a row were short.
  void lose(const std::string& reason, bool too_late);
  /// Sends a Bye to the connected peers. Empty: the session is over.
  void leave(const std::string& reason);

  uint64_t epochs() const { return epochs_; }

 private:
  void search(std::chrono::milliseconds pause);
  /// What the thread does: the mailbox, or nothing once this role leaves.
  std::unique_ptr<Mailbox> find(std::chrono::milliseconds pause) const;
  std::optional<Ending> take_up_search(const FrameRequest& next);
  std::optional<Ending> warm_up(const FrameRequest& frame);
  /// Receives their messages; true when both are ready.
  Awaited<bool> both_ready();
  std::optional<Ending> compare_clocks();
  void close(const std::string& reason);

  Connect connect_;
  FrameSink& sink_;
  std::function<bool()> stop_;
  std::atomic<bool> leaving_{false};
  std::future<std::unique_ptr<Mailbox>> search_;
  std::unique_ptr<Mailbox> mailbox_;
  std::optional<Inbox> inbox_;
  std::set<Role> ready_;
  HiddenName sent_;  ///< the set of hidden objects that was sent last to those who are connected
  std::chrono::milliseconds frame_limit_{0};
  std::chrono::steady_clock::time_point since_;  ///< of the warm-up, or of the epoch
  uint32_t short_epochs_ = 0;                    ///< in a row
  uint64_t epochs_ = 0;
};

}  // namespace triptych
