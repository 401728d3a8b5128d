// A hosts file whose machines are all this one.
#pragma once

#include <fstream>
#include <string>
#include <unistd.h>

namespace triptych::test {

struct HostsText {
  std::string launch = {};  ///< the program's own where empty
  std::string key_file = {};
  std::string second = "c";  ///< the machine of switch node 1
};

/// Writes the file with ports of this process's own, and returns its name.
inline std::string write_hosts_file(const std::string& file, const HostsText& text = {}) {
  const int port = 28000 + 2 * (::getpid() % 2000);
  std::ofstream out(file);
  // Literal strings of TOML hold a quotation mark of one kind alone; three of them hold all others.
  const auto line = [&](const std::string& key, const std::string& value) {
    if (!value.empty()) out << key << " = '''" << value << "'''\n";
  };
  line("launch", text.launch);
  line("key_file", text.key_file);
  line("program", TRIPTYCH_PROGRAM);
  out << "[render]\naddress = \"127.0.0.1:" << port << "\"\n";
  out << "[switch_0]\nhost = \"b\"\naddress = \"127.0.0.1:" << port + 1 << "\"\n";
  out << "[switch_1]\n";
  line("host", text.second);
  return file;
}

}  // namespace triptych::test
