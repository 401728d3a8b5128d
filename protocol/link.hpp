// One socket that carries messages.
#pragma once

#include "base/error.hpp"
#include "protocol/wire.hpp"

#include <array>
#include <asio/ip/tcp.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace triptych {

/// What went through one socket, handshake included.
struct LinkFigures {
  uint64_t messages_sent = 0, messages_received = 0;
  uint64_t bytes_sent = 0, bytes_received = 0;  ///< headers and bodies
  /// An estimate of what the network carried for them: each segment of 1448 bytes costs 66 more (Ethernet,
  /// IPv4, TCP with timestamps); acknowledgements are not counted.
  uint64_t wire_bytes_sent = 0, wire_bytes_received = 0;
  /// Of delta messages alone: bodies (watermarks and encoded ids), and the ids in them.
  uint64_t deltas_sent = 0, delta_body_bytes_sent = 0, delta_ids_sent = 0;
  uint64_t delta_body_bytes_received = 0, delta_ids_received = 0;
};

/// A connected socket, read in the background of its io_context and written to at once. For one thread.
class Link : public std::enable_shared_from_this<Link> {
 public:
  struct Arrived {
    Message message;
    size_t body_bytes = 0;
  };
  struct Broken {
    std::string reason;  ///< starts with the place
    bool closed;         ///< by the peer, between two messages
  };
  using Outcome = std::variant<Arrived, Broken>;

  /// `place` begins the messages of errors. Makes the socket non-blocking, without Nagle's delay, and has the
  /// kernel notice within about ten seconds that the other machine is gone.
  Link(asio::ip::tcp::socket socket, std::string place);

  /// Waits in the background for one message of at most `limit` body bytes; `done` is called within the
  /// io_context.
  void read(uint32_t limit, std::function<void(Outcome)> done);

  /// Sends bytes that encode() made of the message. While the peer does not take them the io_context runs, so
  /// that two roles that send to each other do not block. Returns why it failed, or nothing.
  std::string write(const Message& message, const std::vector<std::byte>& bytes,
                    std::chrono::milliseconds timeout);

  /// Reads that are under way end without calling anybody.
  void close();

  void set_place(std::string place) { place_ = std::move(place); }
  const std::string& place() const { return place_; }
  const LinkFigures& figures() const { return figures_; }

 private:
  void read_body();
  void finish_read(Outcome outcome);
  std::string reason_of(const asio::error_code& error) const;

  asio::ip::tcp::socket socket_;
  std::string place_;
  LinkFigures figures_;
  std::array<std::byte, header_bytes> header_{};
  MessageHeader parsed_;
  std::vector<std::byte> body_;
  std::function<void(Outcome)> done_;
};

}  // namespace triptych
