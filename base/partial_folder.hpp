// Folders under construction: named after their process, held by it, and removed once it is gone.
#pragma once

#include "base/descriptor.hpp"

#include <filesystem>

namespace triptych {

/// "PATH.partial-PID": made, held by this process, and removed with all that is in it at the end. First
/// removes what processes that are gone left under such names of the same path: this user's folders that
/// nobody holds. Error (its path) if it cannot be made.
class PartialFolder {
 public:
  explicit PartialFolder(const std::filesystem::path& path);
  ~PartialFolder();
  PartialFolder(const PartialFolder&) = delete;
  PartialFolder& operator=(const PartialFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  Descriptor held_;
};

}  // namespace triptych
