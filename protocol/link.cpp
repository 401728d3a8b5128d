#include "protocol/link.hpp"

#include "protocol/delta_codec.hpp"

#include <asio/io_context.hpp>
#include <asio/post.hpp>
#include <netinet/tcp.h>
#include <utility>

namespace triptych {

namespace {

using Clock = std::chrono::steady_clock;

constexpr size_t most_at_once = 1 << 16;
constexpr auto handshake_timeout = std::chrono::milliseconds(500);  // for the few bytes that go out

uint64_t wire_bytes(size_t bytes) { return bytes + 66 * ((bytes + 1447) / 1448); }

uint64_t ids_in(const DeltaMessage& message) {
  const DeltaCounts counts = delta_counts(message.encoded);
  return counts.added + counts.removed;
}

void notice_a_peer_that_is_gone(asio::ip::tcp::socket& socket) {
  asio::error_code ignored;  // a socket that is already broken says so at the first read
  const auto set = [&](int option, int value) {
    if (::setsockopt(socket.native_handle(), IPPROTO_TCP, option, &value, sizeof(value)) != 0) return;
  };
  socket.set_option(asio::socket_base::keep_alive(true), ignored);
  set(TCP_KEEPIDLE, 5);
  set(TCP_KEEPINTVL, 1);
  set(TCP_KEEPCNT, 5);
  set(TCP_USER_TIMEOUT, 10'000);
}

}  // namespace

Link::Link(asio::ip::tcp::socket socket, std::string place)
    : socket_(std::move(socket)), place_(std::move(place)) {
  asio::error_code ignored;
  socket_.non_blocking(true, ignored);
  socket_.set_option(asio::ip::tcp::no_delay(true), ignored);
  notice_a_peer_that_is_gone(socket_);
}

std::string Link::reason_of(const asio::error_code& error) const {
  return place_ + ": " + (error == asio::error::eof ? "closed by the peer" : error.message());
}

void Link::secure(const SharedKey& key, TlsStream::Side side, std::function<void(const std::string&)> done) {
  tls_ = std::make_unique<TlsStream>(key, side);
  secured_ = std::move(done);
  const std::string problem = write_bytes(tls_->to_send(), handshake_timeout);
  if (!problem.empty()) return std::exchange(secured_, nullptr)(problem);
  read_some();
}

void Link::read(uint32_t limit, std::function<void(Outcome)> done) {
  done_ = std::move(done);
  limit_ = limit;
  // A message that is here already is told in its turn, not in the middle of what the caller does.
  asio::post(socket_.get_executor(), [self = shared_from_this()] {
    if (self->done_) self->go_on();
  });
}

void Link::read_some() {
  arriving_.resize(most_at_once);
  socket_.async_read_some(asio::buffer(arriving_),
                          [self = shared_from_this()](const asio::error_code& error, size_t count) {
                            if (!self->done_ && !self->secured_) return;
                            if (!error) return self->take(count);
                            const std::string reason = self->reason_of(error);
                            if (self->secured_) return std::exchange(self->secured_, nullptr)(reason);
                            const std::string half = self->reader_.half_message();
                            if (half.empty()) return self->finish_read(Broken{reason, true});
                            self->finish_read(Broken{reason + " after " + half, false});
                          });
}

void Link::take(size_t count) {
  const auto bytes = std::span<const std::byte>(arriving_).first(count);
  if (!tls_) {
    reader_.bytes().insert(reader_.bytes().end(), bytes.begin(), bytes.end());
    return go_on();
  }
  try {
    tls_->take(bytes, reader_.bytes());
  } catch (const Error& error) {
    const std::string reason = place_ + ": " + error.what();
    write_bytes(tls_->to_send(), std::chrono::milliseconds(0));  // TLS tells the other side why
    if (secured_) return std::exchange(secured_, nullptr)(reason);
    return finish_read(Broken{reason, false});
  }
  if (!secured_) return go_on();
  const std::string problem = write_bytes(tls_->to_send(), handshake_timeout);
  if (!problem.empty() || tls_->established()) return std::exchange(secured_, nullptr)(problem);
  read_some();
}

void Link::go_on() {
  std::optional<Arrived> arrived;
  try {
    arrived = reader_.next(limit_, place_);
  } catch (const Error& problem) {
    return finish_read(Broken{problem.what(), false});
  }
  if (!arrived) return read_some();
  const size_t bytes = header_bytes + arrived->body_bytes;
  ++figures_.messages_received;
  figures_.bytes_received += bytes;
  figures_.wire_bytes_received += wire_bytes(bytes);
  if (const auto* delta = std::get_if<DeltaMessage>(&arrived->message)) {
    figures_.delta_body_bytes_received += arrived->body_bytes;
    figures_.delta_ids_received += ids_in(*delta);
  }
  finish_read(std::move(*arrived));
}

void Link::finish_read(Outcome outcome) {
  // The callback may start the next read.
  const auto done = std::exchange(done_, nullptr);
  done(std::move(outcome));
}

std::string Link::write_bytes(std::span<const std::byte> bytes, std::chrono::milliseconds timeout) {
  const auto deadline = Clock::now() + timeout;
  asio::error_code error;
  size_t sent = 0;
  while (sent < bytes.size()) {
    sent += socket_.write_some(asio::buffer(bytes.data() + sent, bytes.size() - sent), error);
    if (!error) continue;
    if (error != asio::error::would_block && error != asio::error::try_again) return reason_of(error);
    const auto writable = std::make_shared<bool>(false);
    socket_.async_wait(asio::socket_base::wait_write,
                       [writable](const asio::error_code&) { *writable = true; });
    auto& context = static_cast<asio::io_context&>(socket_.get_executor().context());
    while (!*writable && Clock::now() < deadline) context.run_one_until(deadline);
    if (!*writable) {
      return fmt::format("{}: does not take what is sent to it, for {} ms", place_, timeout.count());
    }
  }
  return {};
}

std::string Link::write(const Message& message, const std::vector<std::byte>& bytes,
                        std::chrono::milliseconds timeout) {
  if (tls_ && !tls_->established()) return place_ + ": is not encrypted yet";
  const std::string problem = tls_ ? write_bytes(tls_->seal(bytes), timeout) : write_bytes(bytes, timeout);
  if (!problem.empty()) return problem;
  ++figures_.messages_sent;
  figures_.bytes_sent += bytes.size();
  figures_.wire_bytes_sent += wire_bytes(bytes.size());
  if (const auto* delta = std::get_if<DeltaMessage>(&message)) {
    ++figures_.deltas_sent;
    figures_.delta_body_bytes_sent += bytes.size() - header_bytes;
    figures_.delta_ids_sent += ids_in(*delta);
  }
  return {};
}

TcpFigures Link::kernel_figures() const {
  // Asio's native_handle() is not const, and says only which descriptor it is.
  auto& socket = const_cast<asio::ip::tcp::socket&>(socket_);
  return socket.is_open() ? tcp_figures(socket.native_handle()) : last_kernel_figures_;
}

void Link::close() {
  last_kernel_figures_ = kernel_figures();
  done_ = nullptr;
  secured_ = nullptr;
  asio::error_code ignored;  // closing what is closed already
  socket_.shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
  socket_.close(ignored);
}

}  // namespace triptych
