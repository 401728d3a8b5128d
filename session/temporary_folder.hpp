// A folder of a command's own, for what nobody wants to keep.
#pragma once

#include <filesystem>

namespace triptych {

/// A folder with a new name that goes when this goes.
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
