// Messages out of a stream of bytes, however it was cut on its way.
#pragma once

#include "protocol/wire.hpp"

#include <optional>

namespace triptych {

/// Holds what has come of a message that is not whole yet: never more than was really received.
class MessageReader {
 public:
  struct Arrived {
    Message message;
    size_t body_bytes = 0;
  };

  /// Bytes are appended here.
  std::vector<std::byte>& bytes() { return bytes_; }
  /// The next message once it is whole. Error (place) for what is none, as soon as its header or its body
  /// says so.
  std::optional<Arrived> next(uint32_t limit, const std::string& place);
  /// What has come of a message that is not whole: "frame 12: 20 of 60 bytes". Empty between two messages.
  std::string half_message() const;

 private:
  std::vector<std::byte> bytes_;
  size_t begin_ = 0;  ///< what is before it has been handed out
};

}  // namespace triptych
