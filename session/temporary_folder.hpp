// A temporary folder of a command's own.
#pragma once

#include <filesystem>

namespace triptych {

/// A folder with a new name; the destructor removes it.
class TemporaryFolder {
 public:
  /// Within `parent`; empty: TMPDIR or /tmp. Error if it cannot be made.
  explicit TemporaryFolder(std::filesystem::path parent = {});
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace triptych
