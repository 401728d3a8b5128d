// What each message holds, byte by byte; docs/protocol.md describes it in words.
#pragma once

#include "base/bytes.hpp"
#include "protocol/messages.hpp"

namespace triptych {

/// The type in the header: the message's place in Message; for a delta after which everything is decided,
/// with a mark.
uint32_t type_of(const Message& message);
bool is_message_type(uint32_t type);

void write_message_body(ByteWriter& out, const Message& message);

/// Reads as much as the message takes. Error (place of the reader) for invalid contents.
Message read_message_body(uint32_t type, uint32_t frame, ByteReader& in);

}  // namespace triptych
