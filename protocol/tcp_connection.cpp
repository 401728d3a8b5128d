#include "protocol/tcp_connection.hpp"

#include "protocol/listener.hpp"

#include <netinet/tcp.h>
#include <utility>

namespace triptych {

namespace {

using Clock = std::chrono::steady_clock;

std::string text_of(const asio::error_code& error) {
  return error == asio::error::eof ? closed_by_peer : error.message();
}

void notice_a_peer_that_is_gone(asio::ip::tcp::socket& socket) {
  asio::error_code ignored;  // a socket that is already broken fails at the first read
  const auto set = [&](int option, int value) {
    if (::setsockopt(socket.native_handle(), IPPROTO_TCP, option, &value, sizeof(value)) != 0) return;
  };
  socket.set_option(asio::socket_base::keep_alive(true), ignored);
  set(TCP_KEEPIDLE, 5);
  set(TCP_KEEPINTVL, 1);
  set(TCP_KEEPCNT, 5);
  set(TCP_USER_TIMEOUT, 10'000);
}

std::string place_of(const asio::ip::tcp::socket& socket) {
  asio::error_code error;
  const auto endpoint = socket.remote_endpoint(error);
  return error ? error.message() : to_text({endpoint.address().to_string(), endpoint.port()});
}

class TcpConnection : public Connection, public std::enable_shared_from_this<TcpConnection> {
 public:
  explicit TcpConnection(asio::ip::tcp::socket socket)
      : socket_(std::move(socket)), place_(place_of(socket_)) {
    asio::error_code ignored;
    socket_.non_blocking(true, ignored);
    socket_.set_option(asio::ip::tcp::no_delay(true), ignored);
    notice_a_peer_that_is_gone(socket_);
  }

  void read_some(std::span<std::byte> into, Read done) override {
    socket_.async_read_some(
        asio::buffer(into.data(), into.size()),
        [self = shared_from_this(), done = std::move(done)](const asio::error_code& error, size_t count) {
          if (!self->socket_.is_open()) return;
          done(error ? 0 : count, error ? text_of(error) : "");
        });
  }

  std::string write(std::span<const std::byte> bytes, std::chrono::milliseconds timeout) override {
    const auto deadline = Clock::now() + timeout;
    asio::error_code error;
    while (!bytes.empty()) {
      bytes = bytes.subspan(socket_.write_some(asio::buffer(bytes.data(), bytes.size()), error));
      if (!error) continue;
      if (error != asio::error::would_block && error != asio::error::try_again) return text_of(error);
      const auto writable = std::make_shared<bool>(false);
      socket_.async_wait(asio::socket_base::wait_write,
                         [writable](const asio::error_code&) { *writable = true; });
      while (!*writable && Clock::now() < deadline) context().run_one_until(deadline);
      if (!*writable) return not_taken(timeout);
    }
    return {};
  }

  void close() override {
    last_figures_ = kernel_figures();
    asio::error_code ignored;  // closing what is closed already
    socket_.shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
    socket_.close(ignored);
  }

  asio::io_context& context() override {
    return static_cast<asio::io_context&>(socket_.get_executor().context());
  }
  const std::string& place() const override { return place_; }
  TcpFigures kernel_figures() const override {
    // Asio's native_handle() is not const, and says only which descriptor it is.
    auto& socket = const_cast<asio::ip::tcp::socket&>(socket_);
    return socket.is_open() ? tcp_figures(socket.native_handle()) : last_figures_;
  }

 private:
  asio::ip::tcp::socket socket_;
  std::string place_;
  TcpFigures last_figures_;
};

}  // namespace

std::shared_ptr<Connection> tcp_connection(asio::ip::tcp::socket socket) {
  return std::make_shared<TcpConnection>(std::move(socket));
}

}  // namespace triptych
