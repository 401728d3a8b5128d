// What an earlier process wrote to a file, for a later one that continues it.
#pragma once

#include "base/hashing.hpp"

#include <cstdint>
#include <string>

namespace triptych {

/// The beginning of a file: how many bytes, and their checksum.
struct KeptBytes {
  uint64_t size = 0, checksum = 0;
};

/// Truncates the file to what was kept, adds those bytes to `hash`, a new one, and sets the file's offset to
/// its end. Error (place) if that fails, or if the file holds something else.
void go_on_behind(const KeptBytes& kept, int descriptor, StreamHash& hash, const std::string& place);

}  // namespace triptych
