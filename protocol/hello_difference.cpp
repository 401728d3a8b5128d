#include "protocol/hello_difference.hpp"

#include <fmt/core.h>

namespace triptych {

std::string difference_between(const Hello& own, const Hello& peer) {
  const auto differ = [&](const char* what, const std::string& ours, const std::string& theirs) {
    return fmt::format("{} differs: {} has {}, {} has {}", what, role_name(own.role), ours,
                       role_name(peer.role), theirs);
  };
  if (own.version != peer.version) {
    return differ("protocol version", std::to_string(own.version), std::to_string(peer.version));
  }
  if (own.session != peer.session)
    return differ("session", std::to_string(own.session), std::to_string(peer.session));
  if (own.pack_hash != peer.pack_hash) {
    return differ("pack", fmt::format("{:016x}", own.pack_hash), fmt::format("{:016x}", peer.pack_hash));
  }
  return {};
}

}  // namespace triptych
