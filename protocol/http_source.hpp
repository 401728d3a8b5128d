// A file on a web server, of which ranges are requested.
#pragma once

#include "scene/byte_source.hpp"

#include <memory>
#include <string>

namespace triptych {

/// Whether this names a file on a web server: http:// or https://.
bool is_web_address(const std::string& name);

/// How patient requests are.
struct HttpPatience {
  double connect_s = 10;       ///< for a connection
  double silence_s = 20;       ///< without a byte
  uint32_t tries = 7;          ///< in a row, without a byte that came
  double first_pause_s = 0.1;  ///< between tries, twice as long each time
};

/// Opens it. What is interrupted is requested again, from where it broke off, as HttpPatience says, and said
/// once. Error (address) where there is no such file, where the server has no ranges, and from read() where
/// the file is not the one that was opened any more: by its ETag, its date, or its size.
std::unique_ptr<ByteSource> open_http(const std::string& address, const HttpPatience& patience = {});

}  // namespace triptych
