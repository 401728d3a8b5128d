// One connection that carries messages.
#pragma once

#include "protocol/connection.hpp"
#include "protocol/message_reader.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace triptych {

/// What went through one connection, handshake included.
struct LinkFigures {
  uint64_t messages_sent = 0, messages_received = 0;
  uint64_t bytes_sent = 0, bytes_received = 0;  ///< headers and bodies
  /// An estimate of what they took on the network: each segment of 1448 bytes costs 66 more (Ethernet,
  /// IPv4, TCP with timestamps); acknowledgements are not counted.
  uint64_t wire_bytes_sent = 0, wire_bytes_received = 0;
  /// Of delta messages alone: bodies (watermarks and encoded ids), and the ids in them.
  uint64_t deltas_sent = 0, delta_body_bytes_sent = 0, delta_ids_sent = 0;
  uint64_t delta_body_bytes_received = 0, delta_ids_received = 0;
};

/// Messages over a connection, read in the background of its io_context and written at once. For one thread.
class Link : public std::enable_shared_from_this<Link> {
 public:
  using Arrived = MessageReader::Arrived;
  struct Broken {
    std::string reason;  ///< starts with the place
  };
  using Outcome = std::variant<Arrived, Broken>;

  explicit Link(std::shared_ptr<Connection> connection)
      : connection_(std::move(connection)), place_(connection_->place()) {}

  /// The connection's handshake, where it has one; before anything is read or written. done: called with why
  /// it failed, or an empty text.
  void open(std::function<void(const std::string&)> done);

  /// Waits in the background for one message of at most `limit` body bytes; `done` is called within the
  /// io_context.
  void read(uint32_t limit, std::function<void(Outcome)> done);

  /// Sends bytes that encode() made of the message. While the peer does not take them the io_context runs.
  /// Returns why it failed, or nothing.
  [[nodiscard]] std::string write(const Message& message, const std::vector<std::byte>& bytes,
                                  std::chrono::milliseconds timeout);

  /// Reads that are under way end without calling `done`.
  void close();

  /// From now on messages go over the connection that `wrapper` returns.
  void wrap(const std::function<std::shared_ptr<Connection>(std::shared_ptr<Connection>)>& wrapper) {
    connection_ = wrapper(std::move(connection_));
  }

  void set_place(std::string place) { place_ = std::move(place); }
  const std::string& place() const { return place_; }
  const LinkFigures& figures() const { return figures_; }
  /// The kernel's figures; after close(), the last ones.
  TcpFigures kernel_figures() const { return connection_->kernel_figures(); }

 private:
  void read_some();
  void take(size_t count, const std::string& problem);
  void go_on();
  void finish_read(Outcome outcome);

  std::shared_ptr<Connection> connection_;
  std::string place_;
  LinkFigures figures_;
  std::vector<std::byte> arriving_;  ///< straight from the connection
  MessageReader reader_;
  uint32_t limit_ = 0;
  std::function<void(Outcome)> done_;
  bool closed_ = false;
};

}  // namespace triptych
