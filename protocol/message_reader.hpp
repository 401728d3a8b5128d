// Messages from a stream of bytes, however it was split in transit.
#pragma once

#include "protocol/wire.hpp"

#include <optional>

namespace triptych {

/// Holds the bytes of a message that is not complete yet: never more than were received.
class MessageReader {
 public:
  struct Arrived {
    Message message;
    size_t body_bytes = 0;
  };

  /// Bytes are appended here.
  std::vector<std::byte>& bytes() { return bytes_; }
  /// The next message once it is complete. Error (place) for bytes that are not a message, as soon as header
  /// or body show it.
  std::optional<Arrived> next(uint32_t limit, const std::string& place);
  /// Describes an incomplete message: "frame 12: 20 of 60 bytes". Empty between two messages.
  std::string half_message() const;

 private:
  std::vector<std::byte> bytes_;
  size_t begin_ = 0;  ///< bytes before it have been handed out
};

}  // namespace triptych
