// A file for data that does not fit in memory: bytes are appended, and read at any place.
#pragma once

#include "base/descriptor.hpp"
#include "base/kept_bytes.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace triptych {

/// Where bytes lie in a spool file.
struct SpoolPlace {
  uint64_t offset = 0, size = 0;
  bool operator==(const SpoolPlace&) const = default;
};

/// Unbuffered: bytes for which append() has returned survive the end of the process, however it ends. Several
/// threads may read while one appends.
class SpoolFile {
 public:
  /// Opens or makes the file and truncates it to what was kept. Error (path) if that fails, or if it holds
  /// something else.
  explicit SpoolFile(std::filesystem::path path, const KeptBytes& kept = {});
  /// Takes over a new file; `name` is for errors.
  SpoolFile(std::string name, Descriptor file) : path_(std::move(name)), file_(std::move(file)) {}

  /// Error (path) where the disk is full.
  SpoolPlace append(std::span<const std::byte> bytes);
  /// Error (path, byte) where the file ends before.
  std::vector<std::byte> read(const SpoolPlace& place) const;
  /// Hands out the whole content piece by piece.
  void read_all(const std::function<void(std::span<const std::byte>)>& take) const;
  uint64_t size() const { return size_; }
  /// Size and checksum of the content, for a later process.
  KeptBytes kept() const { return {size_, hash_.checksum()}; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  Descriptor file_;
  uint64_t size_ = 0;
  StreamHash hash_;
};

}  // namespace triptych
