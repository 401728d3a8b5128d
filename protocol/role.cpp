#include "protocol/role.hpp"

namespace triptych {

const std::string& role_name(Role role) {
  static const std::array<std::string, 3> names = {"render node", "switch node 0", "switch node 1"};
  return names[static_cast<size_t>(role)];
}

const std::string& channel_name(Channel channel) {
  static const std::array<std::string, 2> names = {"camera channel", "nodes channel"};
  return names[static_cast<size_t>(channel)];
}

}  // namespace triptych
