// Connections within one process: several roles in one program, each in a thread of its own.
#pragma once

#include "protocol/connection.hpp"

#include <cstddef>
#include <memory>
#include <string>
#include <utility>

namespace triptych {

/// A connection whose two ends can be taken, each once, in the thread of its io_context.
class MemoryWire {
 public:
  enum class End { caller, callee };

  /// capacity: bytes that an end holds for a reader before its writer has to wait.
  explicit MemoryWire(size_t capacity = size_t{1} << 16);
  /// An end that is never taken counts as closed once the wire is destroyed and the other end is closed.
  std::shared_ptr<Connection> take(End end, asio::io_context& context, std::string place) const;

 private:
  struct State;
  class MemoryConnection;
  std::shared_ptr<State> state_;
};

/// Both ends at once.
std::pair<std::shared_ptr<Connection>, std::shared_ptr<Connection>> memory_pair(asio::io_context& caller,
                                                                                asio::io_context& callee,
                                                                                size_t capacity = size_t{1}
                                                                                                  << 16);

}  // namespace triptych
