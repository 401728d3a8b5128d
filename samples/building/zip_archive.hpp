// Files inside a zip archive (minizip).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

namespace triptych {

/// One archive, opened for reading. Threads may read side by side; the reads themselves take turns.
class ZipArchive {
 public:
  /// Error (place: the path) if it cannot be opened or its directory is damaged.
  explicit ZipArchive(const std::filesystem::path& path);
  ~ZipArchive();
  ZipArchive(const ZipArchive&) = delete;
  ZipArchive& operator=(const ZipArchive&) = delete;

  bool contains(const std::string& name) const;
  /// Uncompressed size in bytes; 0 for a name that is not there.
  uint64_t size(const std::string& name) const;
  /// The whole file. Error (place: archive and name) if it is missing or damaged.
  std::string read(const std::string& name) const;
  const std::filesystem::path& path() const { return path_; }

 private:
  struct Directory;
  std::filesystem::path path_;
  std::unique_ptr<Directory> directory_;
  mutable std::mutex mutex_;
};

}  // namespace triptych
