// Roles of one process that find each other without sockets.
#pragma once

#include "protocol/endpoint.hpp"
#include "protocol/memory_connection.hpp"

#include <functional>

namespace triptych {

/// Carries connections between the endpoints of one session. For any number of threads, each with endpoints
/// of its own; it must outlive them.
class MemoryNetwork {
 public:
  /// Wraps the caller's end of each connection: tests put faults in here.
  using Wrapper =
      std::function<std::shared_ptr<Connection>(Role caller, Role callee, std::shared_ptr<Connection>)>;

  explicit MemoryNetwork(Wrapper wrapper = {});
  ~MemoryNetwork();
  MemoryNetwork(const MemoryNetwork&) = delete;
  MemoryNetwork& operator=(const MemoryNetwork&) = delete;

  /// An endpoint at which the role listens from now on, until it is closed; earlier callers are told that
  /// nobody listens.
  std::unique_ptr<Endpoint> endpoint(Role role, asio::io_context& context);

 private:
  struct State;
  class MemoryEndpoint;
  std::shared_ptr<State> state_;
};

}  // namespace triptych
