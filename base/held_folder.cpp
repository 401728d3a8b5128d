#include "base/held_folder.hpp"

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace triptych {

namespace {

enum class Held { by_us, by_another, without_locks };

Descriptor open_folder(const std::filesystem::path& folder) {
  return Descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
}

Held lock(const Descriptor& folder) {
  if (::flock(folder.number(), LOCK_EX | LOCK_NB) == 0) return Held::by_us;
  return errno == EWOULDBLOCK ? Held::by_another : Held::without_locks;
}

/// Whether the name still stands for the open folder, and that is this user's.
bool is_own(const std::filesystem::path& folder, const Descriptor& open) {
  struct stat named {};
  struct stat opened {};
  return ::lstat(folder.c_str(), &named) == 0 && ::fstat(open.number(), &opened) == 0 &&
         named.st_ino == opened.st_ino && named.st_dev == opened.st_dev && opened.st_uid == ::geteuid();
}

}  // namespace

Descriptor hold_folder(const std::filesystem::path& folder) {
  Descriptor open = open_folder(folder);
  if (!open.is_open()) return open;
  if (lock(open) != Held::by_another && is_own(folder, open)) return open;
  errno = EWOULDBLOCK;
  return Descriptor();
}

void remove_forsaken_folders(const std::filesystem::path& parent,
                             const std::function<bool(const std::string& name)>& is_such) {
  std::error_code ignored;
  std::vector<std::filesystem::path> found;
  for (std::filesystem::directory_iterator entry(parent.empty() ? "." : parent, ignored), end;
       !ignored && entry != end; entry.increment(ignored)) {
    if (is_such(entry->path().filename().string())) found.push_back(entry->path());
  }
  for (const auto& folder : found) {
    // Whoever makes one looks, once it is held, whether it has kept its name.
    const Descriptor open = open_folder(folder);
    if (open.is_open() && lock(open) == Held::by_us && is_own(folder, open))
      std::filesystem::remove_all(folder, ignored);
  }
}

}  // namespace triptych
