#include "base/spool_file.hpp"

#include "base/error.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>

namespace triptych {

SpoolFile::SpoolFile(std::filesystem::path path, const KeptBytes& kept)
    : path_(std::move(path)),
      file_(::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)),
      size_(kept.size) {
  if (!file_.is_open()) fail(path_.string(), "cannot be written: {}", std::strerror(errno));
  go_on_behind(kept, file_.number(), hash_, path_.string());
}

SpoolPlace SpoolFile::append(std::span<const std::byte> bytes) {
  const SpoolPlace place{size_, bytes.size()};
  write_all(file_.number(), bytes, path_.string());
  size_ += bytes.size();
  hash_.add(bytes);
  return place;
}

std::vector<std::byte> SpoolFile::read(const SpoolPlace& place) const {
  std::vector<std::byte> bytes(static_cast<size_t>(place.size));
  read_at(file_.number(), place.offset, bytes, path_.string());
  return bytes;
}

void SpoolFile::read_all(const std::function<void(std::span<const std::byte>)>& take) const {
  read_in_stretches(file_.number(), size_, path_.string(), take);
}

}  // namespace triptych
