#include "lod/preprocess/work_folder.hpp"

#include "base/bytes.hpp"
#include "base/descriptor.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/file_access.hpp"
#include "base/hashing.hpp"
#include "base/notice.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

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
  // A build leaves nothing without its lock: this is somebody else's.
  if (!std::filesystem::exists(file("lock"), error) && !std::filesystem::is_empty(folder_, error))
    fail(folder_.string(), "the build would work in this folder, which holds other files");
  lock_ = ::open(file("lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (lock_ < 0) {
    const int problem = errno;
    std::filesystem::remove(folder_, error);  // unless there is something in it
    fail(folder_.string(), "cannot be written: {}", std::strerror(problem));
  }
  struct stat locked {};
  // One that was removed in between was the lock of a build that has just ended.
  if (::flock(lock_, LOCK_EX | LOCK_NB) != 0 || ::fstat(lock_, &locked) != 0 || locked.st_nlink == 0) {
    ::close(lock_);
    fail(pack.string(), "another process is building it");
  }
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
  if (same && (whole || !std::filesystem::exists(file(journal_name), error))) return;
  if (built) {
    notice("{}: what another build left is dropped: {}", folder_.string(),
           same ? "a file of it is missing" : "its files, flags or program were others");
  }
  remove_work();
  write_file(file(fingerprint_name), fingerprint);
}

void WorkFolder::leave() {
  // The lock goes last: whatever is left if this is interrupted is still known to be a build's.
  if (remove_work()) {
    std::error_code error;
    std::filesystem::remove(file("lock"), error);
    std::filesystem::remove(folder_, error);
  }
  ::close(lock_);
}

bool WorkFolder::remove_work() {
  std::error_code error;
  // Without its journal it is no work to go on with, whatever else is still there.
  std::filesystem::remove(file(journal_name), error);
  bool all = true;
  auto entry = std::filesystem::directory_iterator(folder_, error);
  if (error) return false;
  for (; entry != std::filesystem::directory_iterator(); entry.increment(error)) {
    if (entry->path() == file("lock")) continue;
    // Files as such, which takes no descriptor.
    if (!std::filesystem::remove(entry->path(), error)) std::filesystem::remove_all(entry->path(), error);
    all = all && !std::filesystem::exists(entry->path(), error);
  }
  return all;
}

// What comes next goes right behind the last whole record, or nobody would find it again.
BuildJournal::BuildJournal(const WorkFolder& folder)
    : file_(folder.file(journal_name), read_records(folder.file(journal_name))) {}

KeptBytes BuildJournal::read_records(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return {};
  const std::string place = path.string();
  const auto close_file = [](const int* open) { ::close(*open); };
  const int descriptor = open_to_read(path);
  const std::unique_ptr<const int, decltype(close_file)> closes(&descriptor, close_file);
  const uint64_t size = size_of(descriptor, place);
  uint64_t at = 0;
  StreamHash hash;
  while (at + sizeof(RecordHeader) <= size) {
    std::vector<std::byte> bytes(sizeof(RecordHeader));
    read_at(descriptor, at, bytes, place);
    const auto header = ByteReader(bytes, place).read<RecordHeader>();
    const uint64_t first = at + sizeof(RecordHeader);
    if (header.bytes > size - first || header.file_count > header.bytes / sizeof(KeptBytes)) break;
    bytes.resize(sizeof(RecordHeader) + static_cast<size_t>(header.bytes));
    const auto record = std::span(bytes).subspan(sizeof(RecordHeader));
    read_at(descriptor, first, record, place);
    if (hash_bytes(record) != header.checksum) break;
    hash.add(bytes);
    kept_ = ByteReader(record, place).read_all<KeptBytes>(header.file_count);
    const uint64_t skipped = header.file_count * sizeof(KeptBytes);
    records_.push_back({first + skipped, header.bytes - skipped});
    at = first + header.bytes;
  }
  return {at, hash.checksum()};
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
