#include "base/spool_file.hpp"

#include "base/descriptor.hpp"
#include "base/error.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace triptych {

SpoolFile::SpoolFile(std::filesystem::path path, const KeptBytes& kept)
    : path_(std::move(path)), size_(kept.size) {
  file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file_ < 0) fail(path_.string(), "cannot be written: {}", std::strerror(errno));
  try {
    go_on_behind(kept, file_, hash_, path_.string());
  } catch (...) {
    ::close(file_);
    throw;
  }
}

SpoolFile::~SpoolFile() { ::close(file_); }

SpoolPlace SpoolFile::append(std::span<const std::byte> bytes) {
  const SpoolPlace place{size_, bytes.size()};
  write_all(file_, bytes, path_.string());
  size_ += bytes.size();
  hash_.add(bytes);
  return place;
}

std::vector<std::byte> SpoolFile::read(const SpoolPlace& place) const {
  std::vector<std::byte> bytes(static_cast<size_t>(place.size));
  read_at(file_, place.offset, bytes, path_.string());
  return bytes;
}

void SpoolFile::read_all(const std::function<void(std::span<const std::byte>)>& take) const {
  read_in_stretches(file_, size_, path_.string(), take);
}

}  // namespace triptych
