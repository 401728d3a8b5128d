// A temporary folder of a command's own.
#pragma once

#include "base/descriptor.hpp"

#include <filesystem>

namespace triptych {

/// A folder with a new name; the destructor removes it. Where a process is killed before that, the next one
/// that makes such a folder beside it does: who lives holds a lock on its folder, which the system releases
/// with the process. Only this user's folders of that name are looked at.
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
  Descriptor lock_;  ///< of the folder itself; programs that are started do not inherit it
};

}  // namespace triptych
