// The links of one role to its peers.
#pragma once

#include "protocol/link.hpp"
#include "protocol/recording.hpp"

#include <asio/executor_work_guard.hpp>
#include <asio/io_context.hpp>
#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace triptych {

/// A peer that closed its connection without a Bye, was reset, does not read what is sent to it, or sent
/// something that is not a message.
struct PeerLost {
  Role peer = Role::render;
  std::string reason;  ///< one line: "switch node 0 lost: …"
};
PeerLost peer_lost(Role peer, const std::string& reason);

struct Received {
  Role peer;
  Channel channel;
  Message message;
  size_t bytes = 0;  ///< of the message, on the wire
};

using Delivery = std::variant<Received, PeerLost>;

/// How much has arrived and is not used yet.
struct Backlog {
  uint64_t messages = 0, bytes = 0;
};

/// A mailbox that holds this much stops reading from its connections, so that senders wait.
constexpr Backlog mailbox_limit{16'384, uint64_t{2} * body_limit};

/// Reads all connections in the background of receive() and send(); for one thread. Every message that
/// arrived before a peer was lost is handed out before the loss is.
class Mailbox {
 public:
  Mailbox();
  ~Mailbox();
  Mailbox(const Mailbox&) = delete;
  Mailbox& operator=(const Mailbox&) = delete;

  /// The io_context that connections and links must belong to.
  asio::io_context& context() { return context_; }

  void add(Role peer, Channel channel, const std::shared_ptr<Connection>& connection);
  void add(Role peer, Channel channel, const std::shared_ptr<Link>& link);
  bool has(Role peer, Channel channel) const { return links_.count({peer, channel}) != 0; }

  /// From now on the channel's messages go over the connections that `wrapper` returns: for faults.
  void wrap(Channel channel,
            const std::function<std::shared_ptr<Connection>(std::shared_ptr<Connection>)>& wrapper);

  /// Sends at once. Returns the loss of the peer if it is gone; but where messages of a lost peer wait to be
  /// received, receive() reports the loss after them instead. Nothing is sent to a peer whose Bye was
  /// received, or whose loss was reported. Error for a peer that was never connected.
  [[nodiscard]] std::optional<PeerLost> send(Role peer, Channel channel, const Message& message);

  /// The next message in the order of arrival, or nothing within the timeout. A Bye is delivered once per
  /// peer, and the end of the connection after it is not a loss. Each lost peer is reported once; the others
  /// stay connected.
  [[nodiscard]] std::optional<Delivery> receive(std::chrono::milliseconds timeout);

  /// Called with every message that is sent or handed out from now on: for recordings.
  std::function<void(const RecordedMessage&)> observe;

  /// For the handshake: forgets a link that broke before anything was received from it, so that the peer can
  /// come again.
  bool forget_if_broken(Role peer, Channel channel);
  /// For the handshake: which peer has ended and why, if one has.
  struct End {
    Role peer;
    std::string reason;
    bool said_bye;
  };
  std::optional<End> first_end() const;

  /// Says Bye to every peer and closes all links; peers that are gone already are passed over.
  void leave(const std::string& reason);

  /// The largest backlog so far: of messages in the mailbox and of those that the receiver keeps, which it
  /// reports by note_kept().
  Backlog max_backlog() const { return max_backlog_; }
  void note_kept(Backlog kept);

  /// All zero for a link that never existed.
  LinkFigures figures(Role peer, Channel channel) const;
  TcpFigures kernel_figures(Role peer, Channel channel) const;

  void set_send_timeout(std::chrono::milliseconds timeout) { send_timeout_ = timeout; }

  /// The peer's Hello in its handshake; Error if there was none.
  const Hello& peer_hello(Role peer) const;
  void set_peer_hello(const Hello& hello) { hellos_[hello.role] = hello; }

 private:
  struct Entry {
    Role peer;
    Channel channel;
    Link::Outcome outcome;
    double came_ms = 0;  ///< steady clock
  };
  using Key = std::pair<Role, Channel>;

  void read_next(Key key);
  static bool ends(const Entry& entry);
  bool waiting_from(Role peer) const;
  std::optional<Delivery> take_first();
  bool is_full() const;
  void uncount(const Entry& entry);
  void note_most();
  void drop(Role peer);

  asio::io_context context_;
  /// So that waiting works without links, too.
  asio::executor_work_guard<asio::io_context::executor_type> work_;
  std::map<Key, std::shared_ptr<Link>> links_;
  std::map<Role, Hello> hellos_;
  std::set<Role> left_;  ///< said Bye, or was reported as lost
  std::deque<Entry> queue_;
  Backlog queued_, kept_, max_backlog_;
  std::set<Key> paused_;  ///< links that are not read until the queue is shorter
  std::chrono::milliseconds send_timeout_{10'000};
};

}  // namespace triptych
