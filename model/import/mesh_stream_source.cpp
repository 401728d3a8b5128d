#include "model/import/mesh_stream_source.hpp"

#include "base/file_access.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <sys/stat.h>

namespace triptych {

namespace {

constexpr size_t window_bytes = size_t{1} << 18;

int64_t changed_ns(const struct stat& status) {
  return int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + status.st_mtim.tv_nsec;
}

}  // namespace

StreamSource::StreamSource(const std::filesystem::path& file) : name_(file.string()) {
  struct stat status {};
  check_readable(file);
  if (::stat(name_.c_str(), &status) != 0) fail(name_, "cannot be opened: {}", std::strerror(errno));
  size_ = static_cast<uint64_t>(status.st_size);
  changed_ns_ = changed_ns(status);
}

StreamSource::StreamSource(std::string name, Descriptor file)
    : name_(std::move(name)), size_(size_of(file.number(), name_)), file_(std::move(file)) {}

StreamSource::StreamSource(std::string name, std::vector<std::byte> bytes)
    : name_(std::move(name)), size_(bytes.size()), in_memory_(true), bytes_(std::move(bytes)) {}

SourceReader::SourceReader(std::shared_ptr<const StreamSource> source) : source_(std::move(source)) {
  if (!source_->has_file()) return;
  own_ = open_to_read(source_->name());
  struct stat status {};
  if (::fstat(own_.number(), &status) != 0 || static_cast<uint64_t>(status.st_size) != source_->size() ||
      changed_ns(status) != source_->changed_ns_)
    fail(source_->name(), "has changed while it was being read");
}

void SourceReader::read(uint64_t offset, std::span<std::byte> into) const {
  if (offset > source_->size() || into.size() > source_->size() - offset)
    fail(fmt::format("{}: byte {}", source_->name(), offset), "the file ends too soon");
  if (into.empty()) return;
  if (source_->in_memory_) {
    std::memcpy(into.data(), source_->bytes_.data() + offset, into.size());
    return;
  }
  read_at((own_.is_open() ? own_ : source_->file_).number(), offset, into, source_->name());
}

SourceWindow::SourceWindow(std::shared_ptr<const StreamSource> source, uint64_t begin, uint64_t end)
    : reader_(std::move(source)), end_(end), buffer_offset_(begin) {
  const uint64_t size = reader_.source().size();
  if (begin > end || end > size)
    fail(fmt::format("{}: byte {}", reader_.source().name(), size), "the file ends too soon");
}

void SourceWindow::refill(size_t count) {
  if (count > left()) fail(place(), "the file ends too soon");
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(used_),
            buffer_.begin() + static_cast<std::ptrdiff_t>(filled_), buffer_.begin());
  buffer_offset_ += used_;
  filled_ -= used_;
  used_ = 0;
  const uint64_t wanted = std::min<uint64_t>(std::max(count, window_bytes), end_ - buffer_offset_);
  if (buffer_.size() < wanted) buffer_.resize(wanted);
  reader_.read(buffer_offset_ + filled_, std::span(buffer_).subspan(filled_, wanted - filled_));
  filled_ = wanted;
}

void SourceWindow::skip(uint64_t count) {
  if (count > left()) fail(place(), "the file ends too soon");
  const uint64_t buffered = std::min<uint64_t>(count, filled_ - used_);
  used_ += buffered;
  if (buffered == count) return;
  buffer_offset_ += used_ + (count - buffered);
  used_ = filled_ = 0;
}

}  // namespace triptych
