#include "base/descriptor.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace triptych {

void Descriptor::close() {
  if (number_ >= 0) ::close(release());
}

uint64_t size_of(int descriptor, const std::string& place) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) fail(place, "cannot be read: {}", std::strerror(errno));
  return static_cast<uint64_t>(status.st_size);
}

void read_at(int descriptor, uint64_t offset, std::span<std::byte> into, const std::string& place) {
  while (!into.empty()) {
    const ssize_t count = ::pread(descriptor, into.data(), into.size(), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(place, "byte {}: cannot be read: {}", offset, std::strerror(errno));
    if (count == 0) fail(place, "byte {}: the file ends too soon", offset);
    into = into.subspan(static_cast<size_t>(count));
    offset += static_cast<uint64_t>(count);
  }
}

void read_in_stretches(int descriptor, uint64_t size, const std::string& place,
                       const std::function<void(std::span<const std::byte>)>& take) {
  constexpr uint64_t stretch = 1 << 20;
  std::vector<std::byte> bytes;
  for (uint64_t at = 0; at < size; at += bytes.size()) {
    bytes.resize(std::min(stretch, size - at));
    read_at(descriptor, at, bytes, place);
    take(bytes);
  }
}

void write_all(int descriptor, std::span<const std::byte> bytes, const std::string& place) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail(place, "cannot be written: {}", std::strerror(count == 0 ? ENOSPC : errno));
    bytes = bytes.subspan(static_cast<size_t>(count));
  }
}

}  // namespace triptych
