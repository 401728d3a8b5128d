#include "session/temporary_folder.hpp"

#include "base/error.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace triptych {

namespace {

constexpr std::string_view prefix = "triptych-run-";
constexpr size_t random_characters = 6;

Descriptor open_folder(const std::filesystem::path& folder) {
  return Descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
}

/// Whether the name still stands for the open folder, and that is this user's.
bool is_own(const std::filesystem::path& folder, const Descriptor& open) {
  struct stat named {};
  struct stat opened {};
  return ::lstat(folder.c_str(), &named) == 0 && ::fstat(open.number(), &opened) == 0 &&
         named.st_ino == opened.st_ino && named.st_dev == opened.st_dev && opened.st_uid == ::geteuid();
}

/// Removes folders whose processes are gone: nobody holds their locks. What fails does no harm.
void remove_forsaken(const std::filesystem::path& parent) {
  std::error_code ignored;
  for (std::filesystem::directory_iterator entry(parent, ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(prefix) || name.size() != prefix.size() + random_characters) continue;
    const Descriptor folder = open_folder(entry->path());
    if (!folder.is_open() || ::flock(folder.number(), LOCK_EX | LOCK_NB) != 0) continue;
    std::error_code left;
    if (is_own(entry->path(), folder)) std::filesystem::remove_all(entry->path(), left);
  }
}

}  // namespace

TemporaryFolder::TemporaryFolder(std::filesystem::path parent) {
  std::error_code error;
  if (parent.empty()) parent = std::filesystem::temp_directory_path(error);
  if (error) fail("TMPDIR", "names no folder for temporary files: {}", error.message());
  remove_forsaken(parent);
  // Another process may take a folder for a forsaken one before it is locked, and remove it.
  do {
    std::string pattern = (parent / (std::string(prefix) + std::string(random_characters, 'X'))).string();
    if (!::mkdtemp(pattern.data())) fail(pattern, "cannot be made: {}", std::strerror(errno));
    path_ = pattern;
    lock_ = open_folder(path_);
    if (!lock_.is_open() && errno != ENOENT) fail(pattern, "cannot be opened: {}", std::strerror(errno));
  } while (!lock_.is_open() || ::flock(lock_.number(), LOCK_EX) != 0 || !is_own(path_, lock_));
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;  // what cannot be removed does no harm
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace triptych
