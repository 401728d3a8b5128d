#include "base/partial_files.hpp"

#include "base/descriptor.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <fcntl.h>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace triptych {

namespace {

constexpr std::string_view mark = ".partial-";

/// Whether the open file has no name any more.
bool is_nameless(int file) {
  struct stat state {};
  return ::fstat(file, &state) == 0 && state.st_nlink == 0;
}

/// Whether it is a regular file of this user's, and has that name.
bool is_own_file(int file, const std::filesystem::path& name) {
  struct stat opened {};
  struct stat named {};
  return ::fstat(file, &opened) == 0 && ::lstat(name.c_str(), &named) == 0 && S_ISREG(opened.st_mode) &&
         opened.st_uid == ::geteuid() && opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

}  // namespace

std::filesystem::path partial_name(const std::filesystem::path& path) {
  return path.string() + std::string(mark) + std::to_string(::getpid());
}

std::string_view name_of_partial(std::string_view name) {
  const size_t at = name.rfind(mark);
  if (at == std::string_view::npos) return {};
  const std::string_view digits = name.substr(at + mark.size());
  const bool is_partial =
      !digits.empty() && std::all_of(digits.begin(), digits.end(),
                                     [](unsigned char letter) { return std::isdigit(letter) != 0; });
  return is_partial ? name.substr(0, at) : std::string_view();
}

std::FILE* open_partial_file(const std::filesystem::path& partial) {
  // Another process may take it for a forsaken one before it is locked, and remove it.
  constexpr int tries = 100;
  for (int i = 0;; ++i) {
    std::FILE* const file = std::fopen(partial.c_str(), "wbe");
    if (!file) return nullptr;
    const bool locked = ::flock(::fileno(file), LOCK_EX | LOCK_NB) == 0;
    // Some file systems have no locks: there nobody removes anything either.
    if (i == tries || (!is_nameless(::fileno(file)) && (locked || errno != EWOULDBLOCK))) return file;
    std::fclose(file);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

void remove_forsaken_partial_files(const std::filesystem::path& folder) {
  std::error_code ignored;
  for (std::filesystem::directory_iterator entry(folder.empty() ? "." : folder, ignored), end;
       !ignored && entry != end; entry.increment(ignored)) {
    const std::string name = entry->path().filename().string();
    if (name_of_partial(name).empty()) continue;
    const Descriptor file(
        ::open(entry->path().c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
    // Whoever makes one looks, once it is locked, whether it has kept its name.
    if (file.is_open() && ::flock(file.number(), LOCK_EX | LOCK_NB) == 0 &&
        is_own_file(file.number(), entry->path()))
      ::unlink(entry->path().c_str());
  }
}

void remove_forsaken_partial_files_once(const std::filesystem::path& folder) {
  static std::mutex mutex;
  static std::set<std::filesystem::path> seen;
  {
    const std::lock_guard lock(mutex);
    if (!seen.insert(folder).second) return;
  }
  remove_forsaken_partial_files(folder);
}

}  // namespace triptych
