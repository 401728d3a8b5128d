#include "protocol/wire.hpp"

#include "base/bytes.hpp"
#include "base/hashing.hpp"
#include "protocol/message_bodies.hpp"

namespace triptych {

namespace {

static_assert(sizeof(MessageHeader) == header_bytes);
constexpr uint32_t tag_base = 'T' | 'R' << 8 | 'I' << 16;

uint32_t checksum_of(const MessageHeader& header, std::span<const std::byte> body) {
  const uint32_t fields[] = {header.tag, header.frame, header.body_bytes};
  return static_cast<uint32_t>(hash_bytes(body, hash_values(std::span<const uint32_t>(fields))));
}

}  // namespace

std::vector<std::byte> encode(const Message& message) {
  ByteWriter out;
  MessageHeader header;
  out.write(header);
  write_message_body(out, message);
  std::vector<std::byte>& bytes = out.bytes();
  const auto body = std::span<const std::byte>(bytes).subspan(header_bytes);
  if (body.size() > body_limit)
    fail(message_name(message), "{} bytes do not fit into a message", body.size());
  header = {tag_base | type_of(message) << 24, frame_of(message), static_cast<uint32_t>(body.size()), 0};
  header.checksum = checksum_of(header, body);
  std::memcpy(bytes.data(), &header, header_bytes);
  return std::move(bytes);
}

MessageHeader decode_header(std::span<const std::byte, header_bytes> bytes, const std::string& place,
                            uint32_t limit) {
  MessageHeader header;
  std::memcpy(&header, bytes.data(), header_bytes);
  if ((header.tag & 0xffffff) != tag_base) fail(place, "does not speak this protocol");
  const uint32_t type = header.tag >> 24;
  if (!is_message_type(type)) fail(place, "message type {} does not exist", type);
  if (header.body_bytes > limit) {
    fail(place, "frame {}: a message of {} bytes, at most {} are allowed", header.frame, header.body_bytes,
         limit);
  }
  return header;
}

Message decode_body(const MessageHeader& header, std::span<const std::byte> body, const std::string& place) {
  const std::string frame_place = fmt::format("{}: frame {}", place, header.frame);
  if (body.size() != header.body_bytes) {
    fail(frame_place, "a body of {} bytes instead of {}", body.size(), header.body_bytes);
  }
  if (checksum_of(header, body) != header.checksum) fail(frame_place, "a message with a wrong checksum");
  ByteReader in(body, frame_place);
  Message message = read_message_body(header.tag >> 24, header.frame, in);
  in.expect_end();
  if (frame_of(message) != header.frame) fail(frame_place, "a {} of a frame", message_name(message));
  return message;
}

Message decode(std::span<const std::byte> bytes, const std::string& place) {
  if (bytes.size() < header_bytes) fail(place, "byte {}: a header cut short", bytes.size());
  const auto header = decode_header(bytes.first<header_bytes>(), place);
  return decode_body(header, bytes.subspan(header_bytes), place);
}

}  // namespace triptych
