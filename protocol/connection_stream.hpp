// A Connection as the stream that Asio's TLS needs below it.
#pragma once

#include "protocol/connection.hpp"

#include <asio/async_result.hpp>
#include <asio/buffer.hpp>
#include <asio/error.hpp>
#include <asio/post.hpp>
#include <memory>
#include <string>
#include <utility>

namespace triptych {

/// Asio's stream of bytes, over a Connection: asynchronous for a handshake and for reading, synchronous for
/// writing. A failure is asio::error::fault, or asio::error::eof at the end, and problem() says it in words.
class ConnectionStream {
 public:
  using executor_type = asio::io_context::executor_type;
  using lowest_layer_type = ConnectionStream;

  explicit ConnectionStream(std::shared_ptr<Connection> below) : below_(std::move(below)) {}

  Connection& below() const { return *below_; }
  /// What went wrong in the connection below; empty if nothing did.
  const std::string& problem() const { return problem_; }
  /// Limits how long each write from now on may take.
  void limit_writing(std::chrono::milliseconds timeout) { timeout_ = timeout; }

  executor_type get_executor() { return below_->context().get_executor(); }
  lowest_layer_type& lowest_layer() { return *this; }
  const lowest_layer_type& lowest_layer() const { return *this; }

  /// Asio requires it for writes that first have to read, which TLS 1.3 does not have after the handshake.
  template <typename Buffers>
  size_t read_some(const Buffers&, asio::error_code& error) {
    error = asio::error::operation_not_supported;
    return 0;
  }

  template <typename Buffers>
  size_t write_some(const Buffers& buffers, asio::error_code& error) {
    const asio::const_buffer bytes = first_of<asio::const_buffer>(buffers);
    error = note(below_->write({static_cast<const std::byte*>(bytes.data()), bytes.size()}, timeout_));
    return error ? 0 : bytes.size();
  }

  template <typename Buffers, typename Handler>
  auto async_write_some(const Buffers& buffers, Handler&& handler) {
    return asio::async_initiate<Handler, void(asio::error_code, size_t)>(
        [this](auto&& done, const Buffers& from) {
          asio::error_code error;
          const size_t count = write_some(from, error);
          asio::post(get_executor(), [done = std::forward<decltype(done)>(done), error, count]() mutable {
            std::move(done)(error, count);
          });
        },
        handler, buffers);
  }

  template <typename Buffers, typename Handler>
  auto async_read_some(const Buffers& buffers, Handler&& handler) {
    return asio::async_initiate<Handler, void(asio::error_code, size_t)>(
        [this](auto&& done, const Buffers& into) {
          const asio::mutable_buffer bytes = first_of<asio::mutable_buffer>(into);
          // Asio passes no buffer where it only wants to be called back.
          if (bytes.size() == 0) {
            asio::post(get_executor(), [done = std::forward<decltype(done)>(done)]() mutable {
              std::move(done)(asio::error_code(), size_t{0});
            });
            return;
          }
          // A std::function must be copyable, and the handler can only be moved.
          auto kept = std::make_shared<std::decay_t<decltype(done)>>(std::forward<decltype(done)>(done));
          below_->read_some({static_cast<std::byte*>(bytes.data()), bytes.size()},
                            [this, kept](size_t count, const std::string& problem) {
                              const asio::error_code error = note(problem);
                              std::move (*kept)(error, count);
                            });
        },
        handler, buffers);
  }

 private:
  template <typename Buffer, typename Buffers>
  static Buffer first_of(const Buffers& buffers) {
    return *asio::buffer_sequence_begin(buffers);
  }
  asio::error_code note(const std::string& problem) {
    if (problem.empty()) return {};
    problem_ = problem;
    return problem == closed_by_peer ? asio::error_code(asio::error::eof)
                                     : asio::error_code(asio::error::fault);
  }

  std::shared_ptr<Connection> below_;
  std::string problem_;
  std::chrono::milliseconds timeout_{500};  ///< for the few bytes that a handshake sends
};

}  // namespace triptych
