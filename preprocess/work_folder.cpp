#include "preprocess/work_folder.hpp"

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/hashing.hpp"
#include "base/notice.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

namespace triptych {

namespace {

struct RecordHeader {
  uint64_t bytes = 0;       ///< of kept files and record together
  uint64_t checksum = 0;    ///< of those bytes
  uint64_t file_count = 0;  ///< KeptBytes before the record
};

constexpr const char* journal_name = "journal";
constexpr const char* fingerprint_name = "fingerprint";

}  // namespace

WorkFolder::WorkFolder(const std::filesystem::path& pack, const std::string& fingerprint,
                       std::span<const char* const> needed)
    : folder_(pack.string() + ".work") {
  if (std::filesystem::is_directory(pack)) fail(pack.string(), "is a folder, not a file");
  std::error_code error;
  std::filesystem::create_directory(folder_, error);
  if (error) fail(pack.string(), "cannot be written: {}", error.message());
  // Every build leaves its lock: a folder without one is not a build's.
  if (!std::filesystem::exists(file("lock"), error) && !std::filesystem::is_empty(folder_, error))
    fail(folder_.string(), "the build would work in this folder, which holds other files");
  lock_ = Descriptor(::open(file("lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644));
  if (!lock_.is_open()) {
    const int problem = errno;
    std::filesystem::remove(folder_, error);  // fails if it is not empty
    fail(folder_.string(), "cannot be written: {}", std::strerror(problem));
  }
  struct stat locked {};
  // If it was removed in between, it was the lock of a build that has just ended.
  if (::flock(lock_.number(), LOCK_EX | LOCK_NB) != 0 || ::fstat(lock_.number(), &locked) != 0 ||
      locked.st_nlink == 0)
    fail(pack.string(), "another process is building it");
  try {
    take_over(fingerprint, needed);
  } catch (...) {
    leave();
    throw;
  }
}

WorkFolder::~WorkFolder() { leave(); }

void WorkFolder::take_over(const std::string& fingerprint, std::span<const char* const> needed) {
  std::error_code error;
  const bool built = std::filesystem::exists(file(fingerprint_name), error);
  const bool same = built && !fingerprint.empty() && read_text_file(file(fingerprint_name)) == fingerprint;
  const bool whole = std::all_of(needed.begin(), needed.end(), [&](const char* name) {
    return std::filesystem::exists(file(name), error);
  });
  const uint64_t recorded = std::filesystem::file_size(file(journal_name), error);
  if (same && (whole || error || recorded == 0)) return;
  if (built) {
    notice("{}: what another build left is dropped: {}", folder_.string(),
           same ? "a file of it is missing" : "its files, flags or program were others");
  }
  remove_work();
  write_file(file(fingerprint_name), fingerprint);
}

void WorkFolder::leave() {
  // The lock is removed last: if this is interrupted, the folder is still known to be a build's.
  if (remove_work()) {
    std::error_code error;
    std::filesystem::remove(file("lock"), error);
    std::filesystem::remove(folder_, error);
  }
  lock_.close();
}

bool WorkFolder::remove_work() {
  std::error_code error;
  // Without its journal the work cannot be resumed, whatever else is still there.
  std::filesystem::remove(file(journal_name), error);
  bool all = true;
  std::error_code walk;
  auto entry = std::filesystem::directory_iterator(folder_, walk);
  for (; !walk && entry != std::filesystem::directory_iterator(); entry.increment(walk)) {
    if (entry->path() == file("lock")) continue;
    // Plain files are removed without opening a descriptor.
    if (!std::filesystem::remove(entry->path(), error)) std::filesystem::remove_all(entry->path(), error);
    all = all && !std::filesystem::exists(entry->path(), error);
  }
  return all && !walk;
}

// New records go right behind the last whole one, or they could not be found again.
BuildJournal::BuildJournal(const WorkFolder& folder)
    : file_(folder.file(journal_name), read_records(folder.file(journal_name))) {}

KeptBytes BuildJournal::read_records(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return {};
  const std::vector<std::byte> all = read_file(path);
  const std::span<const std::byte> bytes(all);
  size_t at = 0;
  while (bytes.size() - at >= sizeof(RecordHeader)) {
    const auto header = ByteReader(bytes.subspan(at), path.string()).read<RecordHeader>();
    const size_t first = at + sizeof(RecordHeader);
    if (header.bytes > bytes.size() - first || header.file_count > header.bytes / sizeof(KeptBytes)) break;
    const auto record = bytes.subspan(first, static_cast<size_t>(header.bytes));
    if (hash_bytes(record) != header.checksum) break;
    kept_ = ByteReader(record, path.string()).read_all<KeptBytes>(header.file_count);
    const uint64_t skipped = header.file_count * sizeof(KeptBytes);
    records_.push_back({first + skipped, header.bytes - skipped});
    at = first + record.size();
  }
  return {at, hash_bytes(bytes.first(at))};
}

std::optional<std::vector<std::byte>> BuildJournal::replay() {
  if (next_ == records_.size()) return std::nullopt;
  return file_.read(records_[next_++]);
}

void BuildJournal::append(std::span<const std::byte> record, std::span<const KeptBytes> files) {
  ByteWriter body;
  body.write_all(files);
  body.write_all(record);
  ByteWriter writer;
  writer.write(RecordHeader{body.bytes().size(), hash_bytes(body.bytes()), files.size()});
  writer.write_all(std::span<const std::byte>(body.bytes()));
  file_.append(writer.bytes());
}

}  // namespace triptych
