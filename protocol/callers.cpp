#include "protocol/callers.hpp"

#include <fcntl.h>

namespace triptych {

namespace {

using asio::ip::tcp;
using Clock = std::chrono::steady_clock;

constexpr auto silence_limit = std::chrono::seconds(5);  ///< for the Hello of whoever called
constexpr size_t most_waiting = 16;

}  // namespace

Callers::Callers(asio::io_context& context, const Listener& listener, const SharedKey* key, Heard heard)
    : acceptor_(context), key_(key), heard_(std::move(heard)) {
  const int copy = ::fcntl(listener.descriptor(), F_DUPFD_CLOEXEC, 0);
  asio::error_code error;
  acceptor_.assign(listener.is_ipv6() ? tcp::v6() : tcp::v4(), copy, error);
  if (error) fail(to_text(listener.address()), "cannot listen: {}", error.message());
}

void Callers::accept() {
  acceptor_.async_accept([this](const asio::error_code& error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (!error) {
      asio::error_code gone;
      const auto endpoint = socket.remote_endpoint(gone);
      const std::string place = to_text({endpoint.address().to_string(), endpoint.port()});
      if (!gone) greet(std::make_shared<Link>(std::move(socket), place));
    }
    accept();
  });
}

void Callers::greet(const std::shared_ptr<Link>& caller) {
  if (waiting_.size() == most_waiting) {
    waiting_.front().link->close();
    waiting_.pop_front();
  }
  waiting_.push_back({caller, Clock::now()});
  if (key_ == nullptr) return hear(caller);
  caller->secure(*key_, TlsStream::Side::callee, [this, caller](const std::string& problem) {
    if (problem.empty()) return hear(caller);
    forget(caller);
    caller->close();
  });
}

void Callers::hear(const std::shared_ptr<Link>& caller) {
  caller->read(hello_body_limit, [this, caller](Link::Outcome outcome) {
    forget(caller);
    const auto* arrived = std::get_if<Link::Arrived>(&outcome);
    heard_(caller, arrived == nullptr ? nullptr : std::get_if<Hello>(&arrived->message));
  });
}

void Callers::forget(const std::shared_ptr<Link>& caller) {
  std::erase_if(waiting_, [&](const Waiting& other) { return other.link == caller; });
}

void Callers::drop_silent() {
  while (!waiting_.empty() && Clock::now() - waiting_.front().since > silence_limit) {
    waiting_.front().link->close();
    waiting_.pop_front();
  }
}

void Callers::close() {
  for (const Waiting& caller : waiting_) caller.link->close();
  asio::error_code ignored;  // closing what is closed already
  acceptor_.close(ignored);
}

}  // namespace triptych
