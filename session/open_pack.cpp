#include "session/open_pack.hpp"

#include "protocol/http_source.hpp"

namespace triptych {

Pack open_pack(const std::filesystem::path& name) {
  return is_web_address(name.string()) ? Pack(open_http(name.string())) : Pack(name);
}

std::string lasting_name(const std::filesystem::path& name) {
  return is_web_address(name.string()) ? name.string() : std::filesystem::absolute(name).string();
}

}  // namespace triptych
