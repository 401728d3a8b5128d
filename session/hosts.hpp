// Which machine runs which switch node, and how programs are started there.
#pragma once

#include "protocol/listener.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace triptych {

/// One switch node's machine.
struct Host {
  std::string name;      ///< as the launch command needs it
  std::string program;   ///< path of triptych there
  std::string pack;      ///< path of the pack's copy there
  std::string key_file;  ///< path of the key's copy there; empty: no key
};

/// The machines of a session. The render node runs on this one.
struct Hosts {
  std::string launch;    ///< command template with {host}, and {command} or {remote}
  Address render;        ///< where the render node listens, as the others reach it
  Address switch_0;      ///< where switch node 0 listens, as switch node 1 reaches it
  std::string key_file;  ///< on this machine; empty: no key
  std::array<Host, 2> switch_nodes;
};

/// Reads a hosts file (TOML; docs/using.md has an example). pack: the path for hosts that name none. Error
/// (path) for keys that are missing, unknown or of the wrong type.
Hosts read_hosts(const std::filesystem::path& path, const std::string& pack);

/// The line for a shell that starts the program with these arguments on the host: {command} becomes the
/// words, each quoted for that shell, {remote} the same as one word for a second shell on the other machine,
/// as ssh needs it.
std::string launch_line(const Hosts& hosts, const Host& host, const std::vector<std::string>& arguments);

}  // namespace triptych
