// Bytes that are collected: in memory while they are few, then in a temporary file.
#pragma once

#include "base/descriptor.hpp"
#include "model/import/mesh_stream_source.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// Bytes that are appended: in memory at first, then in a temporary file that was unlinked, so that nothing
/// is left of it however the program ends.
class ByteSpool {
 public:
  void append(std::span<const std::byte> bytes);
  uint64_t size() const { return written_ + buffer_.size(); }
  /// Moves all bytes, and those that follow, to a file in the folder. Error (folder) if that fails.
  void move_to_file(const std::filesystem::path& folder);
  /// The bytes in memory: all of them before move_to_file.
  std::span<const std::byte> bytes() const { return buffer_; }
  /// Returns the file, under the name that errors and warnings use; nothing may be appended after that.
  std::shared_ptr<const StreamSource> take_file(const std::string& name);

 private:
  friend class UnpackedBytes;
  void flush();
  std::string name_;
  Descriptor file_;
  uint64_t written_ = 0;
  std::vector<std::byte> buffer_;
};

/// What is unpacked of a file: beyond 32 MiB it goes to a temporary file in the folder.
class UnpackedBytes {
 public:
  UnpackedBytes(std::string name, std::filesystem::path folder)
      : name_(std::move(name)), folder_(std::move(folder)) {}
  void append(std::span<const std::byte> bytes);
  /// All of it, under the name; nothing may be appended after that.
  std::shared_ptr<const StreamSource> take();

 private:
  static constexpr uint64_t max_in_memory = uint64_t{32} << 20;
  std::string name_;
  std::filesystem::path folder_;
  ByteSpool spool_;
};

}  // namespace triptych
