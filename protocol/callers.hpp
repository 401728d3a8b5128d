// Callers of a role that listens: accepted, their Hello read, and turned away where they stay silent.
#pragma once

#include "protocol/endpoint.hpp"
#include "protocol/link.hpp"

#include <chrono>
#include <deque>
#include <functional>
#include <memory>

namespace triptych {

/// Accepts callers and reads the Hello of each. Few may wait at a time, and none for long: the oldest is
/// dropped where there are too many. For one thread.
class Callers {
 public:
  /// Called within the io_context, with a caller and its Hello; null and why if there is none: it does not
  /// know the key, sent something else, or left.
  using Heard = std::function<void(const std::shared_ptr<Link>&, const Hello*, const std::string& problem)>;

  Callers(Endpoint& endpoint, Heard heard) : endpoint_(endpoint), heard_(std::move(heard)) {}

  /// From now on callers are accepted.
  void accept();
  void drop_silent();
  /// Turns away the callers whose Hello has not been read yet. Does not close the endpoint.
  void close();

 private:
  void greet(const std::shared_ptr<Link>& caller);
  void hear(const std::shared_ptr<Link>& caller);
  void forget(const std::shared_ptr<Link>& caller);

  struct Caller {
    std::shared_ptr<Link> link;
    std::chrono::steady_clock::time_point since;
  };
  Endpoint& endpoint_;
  Heard heard_;
  std::deque<Caller> waiting_;  ///< oldest first
};

}  // namespace triptych
