// Those who call a role that listens: let in, heard, and sent away where they stay silent.
#pragma once

#include "protocol/link.hpp"
#include "protocol/listener.hpp"

#include <asio/io_context.hpp>
#include <chrono>
#include <deque>
#include <functional>
#include <memory>

namespace triptych {

/// Accepts callers and reads the Hello of each. Few may wait at a time, and none for long: the oldest goes
/// where there are too many. For one thread; what `heard` throws comes out of the io_context.
class Callers {
 public:
  /// Within the io_context, with a caller and its Hello; null where it said something else, or nothing.
  using Heard = std::function<void(const std::shared_ptr<Link>&, const Hello*)>;

  /// key: callers must know it; null: nothing is encrypted. Error (address) where the listener does not
  /// serve.
  Callers(asio::io_context& context, const Listener& listener, const SharedKey* key, Heard heard);

  /// From now on callers are let in.
  void accept();
  void drop_silent();
  /// Lets nobody in any more, and sends those away who were not heard yet. The listener itself stays open.
  void close();

 private:
  void greet(const std::shared_ptr<Link>& caller);
  void hear(const std::shared_ptr<Link>& caller);
  void forget(const std::shared_ptr<Link>& caller);

  struct Waiting {
    std::shared_ptr<Link> link;
    std::chrono::steady_clock::time_point since;
  };
  asio::ip::tcp::acceptor acceptor_;
  const SharedKey* key_;
  Heard heard_;
  std::deque<Waiting> waiting_;  ///< oldest first
};

}  // namespace triptych
