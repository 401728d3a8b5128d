#include "protocol/messages.hpp"

#include <array>

namespace triptych {

uint32_t frame_of(const Message& message) {
  return std::visit(
      [](const auto& content) -> uint32_t {
        if constexpr (requires { content.frame; }) {
          return content.frame;
        } else {
          return 0;
        }
      },
      message);
}

const std::string& message_name(const Message& message) {
  static const std::array<std::string, std::variant_size_v<Message>> names = {
      "hello",         "camera", "delta", "sentinel",      "full set request", "full set",
      "switch report", "bye",    "ready", "clock request", "clock answer",     "hidden set"};
  return names[message.index()];
}

}  // namespace triptych
