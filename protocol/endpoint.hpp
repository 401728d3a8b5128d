// Where a role's connections come from: an endpoint accepts callers, and calls other roles.
#pragma once

#include "protocol/connection.hpp"
#include "protocol/role.hpp"

#include <functional>
#include <memory>
#include <string>

namespace triptych {

/// One role's access to the others, over sockets or within a process. For one thread; callbacks are called
/// within the io_context, and none after close() or the destructor.
class Endpoint {
 public:
  using Accepted = std::function<void(std::shared_ptr<Connection>)>;
  struct Failure {
    std::string what;
    bool hopeless = false;  ///< trying again is useless
  };
  /// A connection, or null and why there is none.
  using Called = std::function<void(std::shared_ptr<Connection>, const Failure&)>;

  Endpoint() = default;
  virtual ~Endpoint() = default;
  Endpoint(const Endpoint&) = delete;
  Endpoint& operator=(const Endpoint&) = delete;

  /// From now on callers are accepted. Their connections are not opened yet.
  virtual void accept(Accepted accepted) = 0;
  /// Tries once to reach the role. The connection is not opened yet.
  virtual void call(Role role, Called called) = 0;
  /// Accepts no further callers. Connections that were handed out stay open.
  virtual void close() = 0;

  /// For messages: where this role can be called (empty where it cannot), and where that one is called (empty
  /// if it is not known).
  virtual std::string own_address() const = 0;
  virtual std::string address_of(Role role) const = 0;
};

/// Makes the endpoint that belongs to an io_context; called once for each attempt to connect.
using MakeEndpoint = std::function<std::unique_ptr<Endpoint>(asio::io_context&)>;

}  // namespace triptych
