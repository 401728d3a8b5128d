#include "protocol/memory_network.hpp"

#include <asio/post.hpp>
#include <deque>
#include <map>
#include <mutex>
#include <utility>

namespace triptych {

struct MemoryNetwork::State {
  struct Port {
    asio::io_context* context = nullptr;
    std::function<void()> look;  ///< called in the context: a caller may be waiting
    std::deque<std::pair<Role, MemoryWire>> callers;
  };
  Wrapper wrapper;
  std::mutex mutex;
  std::map<Role, Port> ports;  ///< of roles that listen
};

class MemoryNetwork::MemoryEndpoint : public Endpoint {
 public:
  MemoryEndpoint(std::shared_ptr<State> state, Role role, asio::io_context& context)
      : state_(std::move(state)), role_(role), context_(context) {}
  ~MemoryEndpoint() override { MemoryEndpoint::close(); }

  void accept(Accepted accepted) override {
    accepted_ = std::move(accepted);
    const std::lock_guard lock(state_->mutex);
    state_->ports[role_] = {&context_,
                            [this, open = std::weak_ptr(open_)] {
                              if (!open.expired()) let_in();
                            },
                            {}};
  }

  void call(Role role, Called called) override {
    asio::post(context_, [this, open = std::weak_ptr(open_), role, called = std::move(called)] {
      if (open.expired()) return;
      const MemoryWire wire;
      {
        const std::lock_guard lock(state_->mutex);
        const auto port = state_->ports.find(role);
        if (port != state_->ports.end()) {
          port->second.callers.emplace_back(role_, wire);
          asio::post(*port->second.context, port->second.look);
        } else {
          return asio::post(context_, [called, open] {
            if (!open.expired()) called(nullptr, {"nobody listens"});
          });
        }
      }
      auto connection = wire.take(MemoryWire::End::caller, context_, role_name(role));
      if (state_->wrapper) connection = state_->wrapper(role_, role, std::move(connection));
      called(std::move(connection), {});
    });
  }

  void close() override {
    open_.reset();
    std::deque<std::pair<Role, MemoryWire>> turned_away;
    {
      const std::lock_guard lock(state_->mutex);
      const auto port = state_->ports.find(role_);
      if (port == state_->ports.end() || port->second.context != &context_) return;
      turned_away = std::move(port->second.callers);
      state_->ports.erase(port);
    }
    for (const auto& [caller, wire] : turned_away)
      wire.take(MemoryWire::End::callee, context_, role_name(caller))->close();
  }

  std::string own_address() const override { return role_name(role_); }
  std::string address_of(Role role) const override { return role_name(role); }

 private:
  void let_in() {
    for (;;) {
      std::shared_ptr<Connection> connection;
      {
        const std::lock_guard lock(state_->mutex);
        const auto port = state_->ports.find(role_);
        if (port == state_->ports.end() || port->second.callers.empty()) return;
        const auto [caller, wire] = port->second.callers.front();
        port->second.callers.pop_front();
        connection = wire.take(MemoryWire::End::callee, context_, role_name(caller));
      }
      const std::weak_ptr<int> open(open_);
      accepted_(std::move(connection));
      if (open.expired()) return;
    }
  }

  std::shared_ptr<State> state_;
  Role role_;
  asio::io_context& context_;
  Accepted accepted_;
  std::shared_ptr<int> open_ = std::make_shared<int>();  ///< for callbacks that come too late
};

MemoryNetwork::MemoryNetwork(Wrapper wrapper) : state_(std::make_shared<State>()) {
  state_->wrapper = std::move(wrapper);
}
MemoryNetwork::~MemoryNetwork() = default;

std::unique_ptr<Endpoint> MemoryNetwork::endpoint(Role role, asio::io_context& context) {
  return std::make_unique<MemoryEndpoint>(state_, role, context);
}

}  // namespace triptych
