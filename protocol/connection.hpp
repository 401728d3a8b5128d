// A connection between two roles: bytes in order, both ways, with back-pressure.
#pragma once

#include "protocol/tcp_figures.hpp"

#include <asio/io_context.hpp>
#include <chrono>
#include <cstddef>
#include <functional>
#include <span>
#include <string>

namespace triptych {

/// The seam behind which TCP, TLS and memory stand. One end of a connection belongs to one io_context and to
/// the thread that runs it. A problem is a line of text that says what went wrong, without the place; empty
/// where nothing did.
class Connection {
 public:
  using Opened = std::function<void(const std::string& problem)>;
  using Read = std::function<void(size_t count, const std::string& problem)>;

  Connection() = default;
  virtual ~Connection() = default;
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Meets the other end in the background, where the connection has a handshake. Nothing is read or written
  /// before `done` was called, which may happen before this returns.
  virtual void open(Opened done) { done(""); }

  /// Waits in the background for at least one byte. `done` is called within the io_context: with the number
  /// of bytes that were put into `into`, which is not empty, or with a problem ("closed by the peer" at the
  /// end). One read at a time; `into` must live until `done` was called or destroyed.
  virtual void read_some(std::span<std::byte> into, Read done) = 0;

  /// Sends all bytes. While the other end does not take them the io_context runs, so that two roles that send
  /// to each other do not block; where it takes them at once, nothing runs. It is a problem if they are not
  /// all taken within the timeout.
  virtual std::string write(std::span<const std::byte> bytes, std::chrono::milliseconds timeout) = 0;

  /// Ends both directions; what was written still arrives. A handshake or a read that is under way ends
  /// without calling `done`.
  virtual void close() = 0;

  virtual asio::io_context& context() = 0;
  /// Where the other end is, for messages: "127.0.0.1:7001".
  virtual const std::string& place() const = 0;
  /// The kernel's figures of the connection; all zero where it does not go through the kernel. After close():
  /// the last ones.
  virtual TcpFigures kernel_figures() const { return {}; }
};

/// The problem of a read after the last byte.
/// Begins the problem of a handshake in which the two ends do not agree.
inline const std::string handshake_failed = "TLS: the handshake failed";
inline const std::string closed_by_peer = "closed by the peer";
/// The problem of a write that timed out.
std::string not_taken(std::chrono::milliseconds timeout);

}  // namespace triptych
