#include "protocol/link.hpp"

#include "protocol/delta_codec.hpp"

#include <asio/io_context.hpp>
#include <asio/read.hpp>
#include <asio/write.hpp>
#include <netinet/tcp.h>

namespace triptych {

namespace {

using Clock = std::chrono::steady_clock;

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

void Link::read(uint32_t limit, std::function<void(Outcome)> done) {
  done_ = std::move(done);
  auto self = shared_from_this();
  asio::async_read(socket_, asio::buffer(header_),
                   [self, limit](const asio::error_code& error, size_t count) {
                     if (!self->done_) return;
                     if (error) {
                       self->finish_read(Broken{self->reason_of(error), count == 0});
                       return;
                     }
                     try {
                       self->parsed_ = decode_header(self->header_, self->place_, limit);
                     } catch (const Error& problem) {
                       self->finish_read(Broken{problem.what(), false});
                       return;
                     }
                     self->read_body();
                   });
}

void Link::read_body() {
  body_.resize(parsed_.body_bytes);
  auto self = shared_from_this();
  asio::async_read(socket_, asio::buffer(body_), [self](const asio::error_code& error, size_t count) {
    if (!self->done_) return;
    if (error) {
      self->finish_read(
          Broken{fmt::format("{}: frame {}: {} after {} of {} bytes", self->place_, self->parsed_.frame,
                             error == asio::error::eof ? "closed by the peer" : error.message(), count,
                             self->body_.size()),
                 false});
      return;
    }
    Arrived arrived;
    try {
      arrived = {decode_body(self->parsed_, self->body_, self->place_), self->body_.size()};
    } catch (const Error& problem) {
      self->finish_read(Broken{problem.what(), false});
      return;
    }
    LinkFigures& figures = self->figures_;
    const size_t bytes = header_bytes + arrived.body_bytes;
    ++figures.messages_received;
    figures.bytes_received += bytes;
    figures.wire_bytes_received += wire_bytes(bytes);
    if (const auto* delta = std::get_if<DeltaMessage>(&arrived.message)) {
      figures.delta_body_bytes_received += arrived.body_bytes;
      figures.delta_ids_received += ids_in(*delta);
    }
    self->finish_read(std::move(arrived));
  });
}

void Link::finish_read(Outcome outcome) {
  // The callback may start the next read.
  const auto done = std::exchange(done_, nullptr);
  done(std::move(outcome));
}

std::string Link::write(const Message& message, const std::vector<std::byte>& bytes,
                        std::chrono::milliseconds timeout) {
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

void Link::close() {
  done_ = nullptr;
  asio::error_code ignored;  // closing what is closed already
  socket_.shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
  socket_.close(ignored);
}

}  // namespace triptych
