// What ends an epoch, and values that are awaited until they arrive or the epoch ends.
#pragma once

#include "protocol/mailbox.hpp"

#include <string>
#include <utility>
#include <variant>

namespace triptych {

/// Why a role stops working with its peers.
struct Ending {
  enum class Cause {
    peer_lost,     ///< gone, left by itself, sent something invalid, or kept this role waiting too long
    session_over,  ///< a peer said so
    stopped,       ///< this process is to end
  };
  Cause cause = Cause::session_over;
  Role peer = Role::render;  ///< the one that is lost
  std::string reason = {};   ///< of its loss, one line: "switch node 0 lost: …"
  bool too_late = false;     ///< it may still be there, but did not answer in time
};

inline Ending ending_of(PeerLost lost) {
  return {.cause = Ending::Cause::peer_lost, .peer = lost.peer, .reason = std::move(lost.reason)};
}
inline Ending ending_of_lost(Role peer, const std::string& reason) {
  return ending_of(peer_lost(peer, reason));
}

/// A value that was waited for, or what ended the waiting.
template <typename Value>
class [[nodiscard]] Awaited {
 public:
  // Both are meant to convert.
  Awaited(Value value) : content_(std::move(value)) {}
  Awaited(Ending ending) : content_(std::move(ending)) {}

  explicit operator bool() const { return std::holds_alternative<Value>(content_); }
  Value& operator*() { return std::get<Value>(content_); }
  const Value& operator*() const { return std::get<Value>(content_); }
  Value* operator->() { return &std::get<Value>(content_); }
  const Value* operator->() const { return &std::get<Value>(content_); }
  const Ending& ending() const { return std::get<Ending>(content_); }

 private:
  std::variant<Value, Ending> content_;
};

}  // namespace triptych
