// The links of one role to its peers.
#pragma once

#include "base/error.hpp"
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

/// A peer that closed its socket without a Bye, was reset, does not take what it is sent, or sent what is no
/// message.
class PeerLost : public Error {
 public:
  PeerLost(Role lost, const std::string& reason, bool in_vain = false)
      : Error(role_name(lost) + " lost", reason), peer(lost), too_late(in_vain) {}
  Role peer;
  bool too_late;  ///< it may be there, but was waited for too long
};

struct Received {
  Role peer;
  Channel channel;
  Message message;
  size_t bytes = 0;  ///< of it, on the wire
};

/// What has arrived and is not used yet.
struct Waiting {
  uint64_t messages = 0, bytes = 0;
};

/// A mailbox that holds so much reads no more from its sockets: whoever sends then waits.
constexpr Waiting mailbox_limit{16'384, uint64_t{2} * body_limit};

/// Reads all sockets in the background of receive() and send(); for one thread. Every message that arrived
/// before a peer was lost is handed out before the loss is.
class Mailbox {
 public:
  Mailbox();
  ~Mailbox();
  Mailbox(const Mailbox&) = delete;
  Mailbox& operator=(const Mailbox&) = delete;

  /// Sockets and links belong to this.
  asio::io_context& context() { return context_; }

  void add(Role peer, Channel channel, asio::ip::tcp::socket socket);
  void add(Role peer, Channel channel, std::shared_ptr<Link> link);
  bool has(Role peer, Channel channel) const { return links_.count({peer, channel}) != 0; }

  /// Sends at once. PeerLost if the peer is gone; where messages of a peer that is gone wait to be received,
  /// receive() throws it after them instead. To a peer whose Bye was received, or whose loss was thrown,
  /// nothing is sent.
  void send(Role peer, Channel channel, const Message& message);

  /// The next message in the order of arrival, or nothing within the timeout. A Bye is delivered, once a
  /// peer, and what follows it is not an error. Throws PeerLost, once for each peer that is lost; the others
  /// go on.
  std::optional<Received> receive(std::chrono::milliseconds timeout);

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

  /// The most that was there at one time: here, and kept by whoever receives, who says so.
  Waiting most_waiting() const { return most_waiting_; }
  void note_kept(Waiting kept);

  /// All zero for a link that never was.
  LinkFigures figures(Role peer, Channel channel) const;
  TcpFigures kernel_figures(Role peer, Channel channel) const;

  void set_send_timeout(std::chrono::milliseconds timeout) { send_timeout_ = timeout; }

  /// What the peer said of itself in its handshake; Error if there was none.
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
  std::optional<Received> take_first();
  bool is_full() const;
  void uncount(const Entry& entry);
  void note_most();
  void drop(Role peer);

  asio::io_context context_;
  asio::executor_work_guard<asio::io_context::executor_type>
      work_;  ///< so that waiting waits, without links too
  std::map<Key, std::shared_ptr<Link>> links_;
  std::map<Role, Hello> hellos_;
  std::set<Role> left_;  ///< said Bye, or was reported as lost
  std::deque<Entry> queue_;
  Waiting queued_, kept_, most_waiting_;
  std::set<Key> paused_;  ///< links that are not read until the queue is shorter
  std::chrono::milliseconds send_timeout_{10'000};
  uint64_t nodes_messages_ = 0;
};

}  // namespace triptych
