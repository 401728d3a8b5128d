#include "base/spool_file.hpp"

#include "base/descriptor.hpp"
#include "base/error.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace triptych {

SpoolFile::SpoolFile(std::filesystem::path path, uint64_t keep) : path_(std::move(path)) {
  file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file_ < 0) fail(path_.string(), "cannot be written: {}", std::strerror(errno));
  try {
    truncate(keep);
  } catch (...) {
    ::close(file_);
    throw;
  }
}

SpoolFile::~SpoolFile() { ::close(file_); }

void SpoolFile::truncate(uint64_t size) {
  const off_t end = ::lseek(file_, 0, SEEK_END);
  if (end < 0 || static_cast<uint64_t>(end) < size || ::ftruncate(file_, static_cast<off_t>(size)) != 0 ||
      ::lseek(file_, 0, SEEK_END) < 0) {
    fail(path_.string(), "does not hold the {} bytes that were kept in it", size);
  }
  size_ = size;
}

SpoolPlace SpoolFile::append(std::span<const std::byte> bytes) {
  const SpoolPlace place{size_, bytes.size()};
  write_all(file_, bytes, path_.string());
  size_ += bytes.size();
  return place;
}

std::vector<std::byte> SpoolFile::read(const SpoolPlace& place) const {
  std::vector<std::byte> bytes(static_cast<size_t>(place.size));
  read_at(file_, place.offset, bytes, path_.string());
  return bytes;
}

}  // namespace triptych
