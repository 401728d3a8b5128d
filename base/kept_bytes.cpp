#include "base/kept_bytes.hpp"

#include "base/descriptor.hpp"
#include "base/error.hpp"

#include <cerrno>
#include <cstring>
#include <unistd.h>

namespace triptych {

void go_on_behind(const KeptBytes& kept, int descriptor, StreamHash& hash, const std::string& place) {
  if (size_of(descriptor, place) < kept.size)
    fail(place, "does not hold the {} bytes that were kept in it", kept.size);
  read_in_stretches(descriptor, kept.size, place, [&](std::span<const std::byte> bytes) { hash.add(bytes); });
  if (kept.size > 0 && hash.checksum() != kept.checksum)
    fail(place, "was changed after the process that wrote it ended");
  if (::ftruncate(descriptor, static_cast<off_t>(kept.size)) != 0 || ::lseek(descriptor, 0, SEEK_END) < 0)
    fail(place, "cannot be written: {}", std::strerror(errno));
}

}  // namespace triptych
