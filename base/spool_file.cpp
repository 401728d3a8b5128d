#include "base/spool_file.hpp"

#include "base/error.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace triptych {

SpoolFile::SpoolFile(std::filesystem::path path, uint64_t keep) : path_(std::move(path)), size_(keep) {
  file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file_ < 0) fail(path_.string(), "cannot be written: {}", std::strerror(errno));
  const off_t end = ::lseek(file_, 0, SEEK_END);
  if (end < 0 || static_cast<uint64_t>(end) < keep || ::ftruncate(file_, static_cast<off_t>(keep)) != 0) {
    ::close(file_);
    fail(path_.string(), "does not hold the {} bytes that were kept in it", keep);
  }
}

SpoolFile::~SpoolFile() { ::close(file_); }

SpoolPlace SpoolFile::append(std::span<const std::byte> bytes) {
  const SpoolPlace place{size_, bytes.size()};
  for (size_t done = 0; done < bytes.size();) {
    const ssize_t count =
        ::pwrite(file_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(size_ + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) fail(path_.string(), "cannot be written: {}", std::strerror(count == 0 ? ENOSPC : errno));
    done += static_cast<size_t>(count);
  }
  size_ += bytes.size();
  return place;
}

std::vector<std::byte> SpoolFile::read(const SpoolPlace& place) const {
  std::vector<std::byte> bytes(static_cast<size_t>(place.size));
  for (size_t done = 0; done < bytes.size();) {
    const ssize_t count =
        ::pread(file_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(place.offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0)
      fail(path_.string(), "byte {}: cannot be read: {}", place.offset + done,
           count == 0 ? "the file ends" : std::strerror(errno));
    done += static_cast<size_t>(count);
  }
  return bytes;
}

}  // namespace triptych
