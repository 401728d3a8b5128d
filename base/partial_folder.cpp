#include "base/partial_folder.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/held_folder.hpp"
#include "base/partial_files.hpp"

#include <cerrno>
#include <cstring>
#include <string>

namespace triptych {

PartialFolder::PartialFolder(const std::filesystem::path& path) : path_(partial_name(path)) {
  remove_forsaken_folders(path.parent_path(), [&](const std::string& name) {
    return name_of_partial(name) == path.filename().string();
  });
  // Another process may take it for a forsaken one before it is held, and remove it.
  constexpr int tries = 100;
  for (int i = 0; i < tries && !held_.is_open(); ++i) {
    make_folder(path_);
    held_ = hold_folder(path_);
    if (!held_.is_open() && errno != EWOULDBLOCK && errno != ENOENT) break;
  }
  if (!held_.is_open()) fail(path_.string(), "cannot be made: {}", std::strerror(errno));
}

PartialFolder::~PartialFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace triptych
