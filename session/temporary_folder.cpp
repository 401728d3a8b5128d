#include "session/temporary_folder.hpp"

#include "base/error.hpp"
#include "base/held_folder.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <unistd.h>

namespace triptych {

namespace {

constexpr std::string_view prefix = "triptych-run-";
constexpr size_t random_characters = 6;

}  // namespace

TemporaryFolder::TemporaryFolder(std::filesystem::path parent) {
  std::error_code error;
  if (parent.empty()) parent = std::filesystem::temp_directory_path(error);
  if (error) fail("TMPDIR", "names no folder for temporary files: {}", error.message());
  remove_forsaken_folders(parent, [](const std::string& name) {
    return name.starts_with(prefix) && name.size() == prefix.size() + random_characters;
  });
  // Another process may take a folder for a forsaken one before it is locked, and remove it.
  do {
    std::string pattern = (parent / (std::string(prefix) + std::string(random_characters, 'X'))).string();
    if (!::mkdtemp(pattern.data())) fail(pattern, "cannot be made: {}", std::strerror(errno));
    path_ = pattern;
    lock_ = hold_folder(path_);
    if (!lock_.is_open() && errno != ENOENT && errno != EWOULDBLOCK)
      fail(pattern, "cannot be opened: {}", std::strerror(errno));
  } while (!lock_.is_open());
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;  // what cannot be removed does no harm
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace triptych
