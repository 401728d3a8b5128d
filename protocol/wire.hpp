// Messages as bytes: a header of 16 bytes with length and checksum, then the body. Reading is total: any
// bytes are either a message or an Error with their place.
#pragma once

#include "protocol/messages.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace triptych {

inline constexpr size_t header_bytes = 16;
/// The longest body that a role accepts from a peer that it knows, and from a caller that it does not know
/// yet.
inline constexpr uint32_t body_limit = 64u << 20;
inline constexpr uint32_t hello_body_limit = 4096;
/// Texts are cut to this many bytes by the sender.
inline constexpr size_t text_limit = 1000;

/// The bytes "TRI" and the message's type, frame, length of the body, low 32 bits of the checksum;
/// little-endian. The type's high bit marks a delta after which everything is decided.
struct MessageHeader {
  uint32_t tag = 0, frame = 0, body_bytes = 0, checksum = 0;
};

/// Header and body. Control characters in texts become spaces. Error for a set that a message cannot hold.
std::vector<std::byte> encode(const Message& message);

/// Error (place) for bytes that are not a message header, a type that does not exist, or a body longer than
/// `limit`.
MessageHeader decode_header(std::span<const std::byte, header_bytes> bytes, const std::string& place,
                            uint32_t limit = body_limit);

/// Error (place, and the frame) for a wrong checksum and for a body that is too short, too long or invalid.
/// Of a Hello of another protocol version only version, roles and channel are read.
Message decode_body(const MessageHeader& header, std::span<const std::byte> body, const std::string& place);

/// Decodes exactly one message. Error for bytes after it.
Message decode(std::span<const std::byte> bytes, const std::string& place);

}  // namespace triptych
