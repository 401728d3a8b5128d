// The decoder of messages, as a link uses it: bytes in pieces, before the handshake and after it. The
// checksums, which a fuzzer cannot guess, are put right first: first byte 0 leaves the input as it is, 1
// mends each message.
#include "base/error.hpp"
#include "base/hashing.hpp"
#include "fuzz_target.hpp"
#include "protocol/message_reader.hpp"

#include <cstdlib>
#include <cstring>

namespace triptych {

namespace {

/// Gives every message that is whole the checksum that its header and body have.
void mend(std::vector<std::byte>& bytes) {
  for (size_t at = 0; bytes.size() - at >= header_bytes;) {
    MessageHeader header;
    std::memcpy(&header, bytes.data() + at, header_bytes);
    if (header.body_bytes > bytes.size() - at - header_bytes) return;
    const std::array<uint32_t, 3> fields = {header.tag, header.frame, header.body_bytes};
    const auto body = std::span<const std::byte>(bytes).subspan(at + header_bytes, header.body_bytes);
    header.checksum = static_cast<uint32_t>(hash_bytes(body, hash_values(std::span<const uint32_t>(fields))));
    std::memcpy(bytes.data() + at, &header, header_bytes);
    at += header_bytes + header.body_bytes;
  }
}

void read(const std::vector<std::byte>& bytes, uint32_t limit) {
  MessageReader reader;
  for (size_t at = 0; at < bytes.size();) {
    const size_t piece = std::min<size_t>(bytes.size() - at, 1 + at % 61);
    reader.bytes().insert(reader.bytes().end(), bytes.begin() + static_cast<std::ptrdiff_t>(at),
                          bytes.begin() + static_cast<std::ptrdiff_t>(at + piece));
    at += piece;
    while (const auto arrived = reader.next(limit, "peer")) {
      // What was read can be written, and read again.
      if (std::holds_alternative<Hello>(arrived->message))
        continue;  // of another version only a part is read
      if (!(decode(encode(arrived->message), "again") == arrived->message)) std::abort();
    }
  }
}

}  // namespace

}  // namespace triptych

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  const auto rest = std::as_bytes(std::span(data + 1, size - 1));
  std::vector<std::byte> bytes(rest.begin(), rest.end());
  if (data[0] % 2 == 1) triptych::mend(bytes);
  for (const uint32_t limit : {triptych::hello_body_limit, triptych::body_limit}) {
    try {
      triptych::read(bytes, limit);
    } catch (const triptych::Error&) {
    }
  }
  return 0;
}
