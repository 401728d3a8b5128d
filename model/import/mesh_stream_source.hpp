// Bytes that stay where they are until they are read: in a file, in an unlinked file, or in memory.
#pragma once

#include "base/descriptor.hpp"
#include "base/error.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// A place of bytes. Keeps no descriptor of a named file open, so that a model may have any number of files.
class StreamSource {
 public:
  /// Notes the file's size and time of change. Error (the path) if it cannot be opened or is not a regular
  /// file.
  explicit StreamSource(const std::filesystem::path& file);
  /// Takes over an open file, which must be complete.
  StreamSource(std::string name, Descriptor file);
  StreamSource(std::string name, std::vector<std::byte> bytes);

  const std::string& name() const { return name_; }
  uint64_t size() const { return size_; }
  /// Whether the name is that of a file with these bytes.
  bool has_file() const { return !in_memory_ && !file_.is_open(); }

 private:
  friend class SourceReader;
  std::string name_;
  uint64_t size_ = 0;
  int64_t changed_ns_ = 0;
  Descriptor file_;  ///< closed if the bytes are in a named file or in memory
  bool in_memory_ = false;
  std::vector<std::byte> bytes_;
};

/// Reads a source at any place. Use one per thread, and one per sequential run, since the kernel reads ahead
/// for each.
class SourceReader {
 public:
  /// Error (name) if the file cannot be opened again or has changed since.
  explicit SourceReader(std::shared_ptr<const StreamSource> source);

  /// Fills `into`. Error (name, byte) if the source ends before.
  void read(uint64_t offset, std::span<std::byte> into) const;
  const StreamSource& source() const { return *source_; }

 private:
  std::shared_ptr<const StreamSource> source_;
  Descriptor own_;  ///< open if the bytes are in a named file
};

/// A range of a source from front to back, through a buffer.
class SourceWindow {
 public:
  SourceWindow(std::shared_ptr<const StreamSource> source, uint64_t begin, uint64_t end);

  /// The next `count` bytes in one piece, valid until the next call. Error (name, byte) beyond the end.
  const std::byte* take(size_t count) {
    if (filled_ - used_ < count) refill(count);
    const std::byte* taken = buffer_.data() + used_;
    used_ += count;
    return taken;
  }
  void skip(uint64_t count);
  uint64_t offset() const { return buffer_offset_ + used_; }
  uint64_t left() const { return end_ - offset(); }
  std::string place() const { return fmt::format("{}: byte {}", reader_.source().name(), offset()); }

 private:
  void refill(size_t count);

  SourceReader reader_;
  uint64_t end_, buffer_offset_;
  std::vector<std::byte> buffer_;
  size_t used_ = 0, filled_ = 0;
};

}  // namespace triptych
