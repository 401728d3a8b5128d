#include "protocol/message_reader.hpp"

#include <cstring>
#include <fmt/core.h>

namespace triptych {

std::optional<MessageReader::Arrived> MessageReader::next(uint32_t limit, const std::string& place) {
  const auto left = std::span<const std::byte>(bytes_).subspan(begin_);
  if (left.size() < header_bytes) return std::nullopt;
  const MessageHeader header = decode_header(left.first<header_bytes>(), place, limit);
  if (left.size() - header_bytes < header.body_bytes) return std::nullopt;
  Arrived arrived{decode_body(header, left.subspan(header_bytes, header.body_bytes), place),
                  header.body_bytes};
  begin_ += header_bytes + header.body_bytes;
  if (begin_ == bytes_.size() || begin_ > bytes_.size() / 2) {
    bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(begin_));
    begin_ = 0;
  }
  return arrived;
}

std::string MessageReader::half_message() const {
  const size_t left = bytes_.size() - begin_;
  if (left == 0) return {};
  if (left < header_bytes) return fmt::format("{} of {} bytes of a header", left, header_bytes);
  MessageHeader header;
  std::memcpy(&header, bytes_.data() + begin_, header_bytes);
  return fmt::format("frame {}: {} of {} bytes", header.frame, left - header_bytes, header.body_bytes);
}

}  // namespace triptych
