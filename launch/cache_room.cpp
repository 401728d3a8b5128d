#include "launch/cache_room.hpp"

#include "base/descriptor.hpp"
#include "base/error.hpp"
#include "base/held_folder.hpp"
#include "base/in_threes.hpp"
#include "base/notice.hpp"
#include "base/partial_files.hpp"
#include "launch/entry_lock.hpp"

#include <algorithm>
#include <chrono>
#include <fcntl.h>
#include <mutex>
#include <string>
#include <string_view>
#include <sys/file.h>
#include <vector>

namespace triptych {

namespace {

namespace fs = std::filesystem;

struct Entry {
  fs::path folder;
  fs::file_time_type wanted;  ///< the last time
  uint64_t bytes = 0;
};

/// NAME-0123456789abcdef.
bool is_name_of_entry(std::string_view name) {
  constexpr size_t digits = 16;
  return name.size() > digits && name[name.size() - digits - 1] == '-' &&
         name.find_first_not_of("0123456789abcdef", name.size() - digits) == std::string_view::npos;
}

/// Whether the folder is an entry of the cache: it has such a name, and a lock.
bool is_entry(const fs::path& folder) {
  std::error_code error;
  return is_name_of_entry(folder.filename().string()) && fs::is_regular_file(folder / EntryLock::name, error);
}

uint64_t bytes_in(const fs::path& folder) {
  uint64_t bytes = 0;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code none;
    if (entry->is_regular_file(none)) bytes += entry->file_size(none);
  }
  return bytes;
}

/// The one that was wanted the longest time ago first.
std::vector<Entry> entries_of(const fs::path& cache) {
  std::vector<Entry> entries;
  std::error_code error;
  for (fs::directory_iterator entry(cache, error), end; !error && entry != end; entry.increment(error)) {
    if (!is_entry(entry->path())) continue;
    std::error_code gone;
    const auto wanted = fs::last_write_time(entry->path() / EntryLock::name, gone);
    if (!gone) entries.push_back({entry->path(), wanted, bytes_in(entry->path())});
  }
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.wanted < b.wanted; });
  return entries;
}

/// Whether a process uses a pack of the entry.
bool is_in_use(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator file(folder, error), end; !error && file != end; file.increment(error)) {
    if (file->path().extension() != ".tpk" || !file->is_regular_file(error)) continue;
    const Descriptor pack(::open(file->path().c_str(), O_RDONLY | O_CLOEXEC));
    if (!pack.is_open() || ::flock(pack.number(), LOCK_EX | LOCK_NB) != 0) return true;
  }
  return static_cast<bool>(error);
}

/// Whether it is gone.
bool remove_entry(const fs::path& folder) {
  try {
    const EntryLock lock(folder);
    if (!lock.try_now() || is_in_use(folder)) return false;
    // Under another name: whoever wants the entry from now on makes a new one, which stays.
    std::error_code error;
    const fs::path doomed = partial_name(folder);
    fs::rename(folder, doomed, error);
    if (!error) fs::remove_all(doomed, error);
    return !error;
  } catch (const Error&) {
    return false;  // it is another user's
  }
}

uint64_t tenth_of_disk(const fs::path& folder) {
  std::error_code error;
  const fs::space_info space = fs::space(folder, error);
  return error ? UINT64_MAX : space.capacity / 10;
}

}  // namespace

void make_room(const fs::path& cache, std::optional<uint64_t> limit, const fs::path& own) {
  constexpr std::chrono::hours patience(60 * 24);
  const auto long_ago = fs::file_time_type::clock::now() - patience;
  const uint64_t most = limit.value_or(tenth_of_disk(cache));
  // What a process that was killed had not removed yet.
  remove_forsaken_folders(cache,
                          [](const std::string& name) { return is_name_of_entry(name_of_partial(name)); });
  const std::vector<Entry> entries = entries_of(cache);
  uint64_t bytes = 0, freed = 0;
  for (const Entry& entry : entries) bytes += entry.bytes;
  size_t gone = 0;
  for (const Entry& entry : entries) {
    const bool unused = entry.wanted < long_ago;
    if (entry.folder == own || (!unused && bytes <= most) || !remove_entry(entry.folder)) continue;
    bytes -= entry.bytes;
    if (unused) continue;
    freed += entry.bytes;
    ++gone;
  }
  if (gone > 0)
    notice("{}: {} pack{} of {} bytes left it, wanted the longest time ago: it may take {} (--cache-limit)",
           cache.string(), gone, gone > 1 ? "s" : "", in_threes(static_cast<double>(freed)),
           in_threes(static_cast<double>(most)));
}

void keep_in_use(const fs::path& pack) {
  static std::mutex mutex;
  static std::vector<Descriptor> packs;
  Descriptor file(::open(pack.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.is_open()) return;                // whoever opens it next says why
  ::flock(file.number(), LOCK_SH | LOCK_NB);  // where there are no locks, nobody removes it either
  const std::lock_guard lock(mutex);
  packs.push_back(std::move(file));
}

}  // namespace triptych
