#include "protocol/tcp_endpoint.hpp"

#include "base/error.hpp"
#include "base/notice.hpp"
#include "protocol/tcp_connection.hpp"

#include <asio/connect.hpp>
#include <asio/steady_timer.hpp>
#include <fcntl.h>
#include <optional>

namespace triptych {

namespace {

using asio::ip::tcp;

class TcpEndpoint : public Endpoint {
 public:
  TcpEndpoint(asio::io_context& context, const Listener* listener, const std::map<Role, Address>& addresses,
              const SharedKey* key)
      : context_(context), listener_(listener), addresses_(addresses), key_(key) {
    if (listener == nullptr) return;
    const int copy = ::fcntl(listener->descriptor(), F_DUPFD_CLOEXEC, 0);
    asio::error_code error;
    acceptor_.emplace(context);
    acceptor_->assign(listener->is_ipv6() ? tcp::v6() : tcp::v4(), copy, error);
    if (error) fail(own_address(), "cannot listen: {}", error.message());
  }
  ~TcpEndpoint() override { TcpEndpoint::close(); }

  void accept(Accepted accepted) override {
    if (!acceptor_) return;
    acceptor_->async_accept([this, open = std::weak_ptr(open_), accepted = std::move(accepted)](
                                const asio::error_code& error, tcp::socket socket) {
      if (open.expired()) return;
      asio::error_code gone;
      if (!error) socket.remote_endpoint(gone);
      if (!error && !gone) accepted(connection(std::move(socket), TlsSide::callee));
      if (open.expired()) return;
      if (!error) return accept(accepted);
      // There are no descriptors left, say: the caller stays in the queue.
      notice_once(fmt::format("{}: cannot accept a caller: {}", own_address(), error.message()));
      const auto pause = std::make_shared<asio::steady_timer>(context_, std::chrono::milliseconds(100));
      pause->async_wait([this, open, pause, accepted](const asio::error_code&) {
        if (!open.expired()) accept(accepted);
      });
    });
  }

  void call(Role role, Called called) override {
    if (endpoints_.count(role) == 0) {
      const Address& address = addresses_.at(role);
      asio::error_code error;
      tcp::resolver resolver(context_);
      const auto found = resolver.resolve(address.host, std::to_string(address.port), error);
      if (error) return called(nullptr, {error.message(), true});
      endpoints_[role] = found;
    }
    const auto socket = std::make_shared<tcp::socket>(context_);
    asio::async_connect(*socket, endpoints_.at(role),
                        [this, open = std::weak_ptr(open_), socket, called = std::move(called)](
                            const asio::error_code& error, const tcp::endpoint&) {
                          if (open.expired()) return;
                          if (error) return called(nullptr, {error.message()});
                          called(connection(std::move(*socket), TlsSide::caller), {});
                        });
  }

  void close() override {
    open_.reset();
    asio::error_code ignored;  // closing what is closed already
    if (acceptor_) acceptor_->close(ignored);
  }

  std::string own_address() const override { return listener_ ? to_text(listener_->address()) : ""; }
  std::string address_of(Role role) const override {
    const auto found = addresses_.find(role);
    return found == addresses_.end() ? "" : to_text(found->second);
  }

 private:
  std::shared_ptr<Connection> connection(tcp::socket socket, TlsSide side) const {
    auto plain = tcp_connection(std::move(socket));
    return key_ ? tls_connection(std::move(plain), *key_, side) : plain;
  }

  asio::io_context& context_;
  const Listener* listener_;
  const std::map<Role, Address>& addresses_;
  const SharedKey* key_;
  std::optional<tcp::acceptor> acceptor_;  ///< empty for a role that does not listen
  std::map<Role, tcp::resolver::results_type> endpoints_;
  std::shared_ptr<int> open_ = std::make_shared<int>();  ///< for callbacks that come too late
};

}  // namespace

std::unique_ptr<Endpoint> tcp_endpoint(asio::io_context& context, const Listener* listener,
                                       const std::map<Role, Address>& addresses, const SharedKey* key) {
  return std::make_unique<TcpEndpoint>(context, listener, addresses, key);
}

}  // namespace triptych
