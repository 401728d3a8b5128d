#include "lod/preprocess/work_folder.hpp"

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/hashing.hpp"
#include "base/notice.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace triptych {

namespace {

struct RecordHeader {
  uint64_t bytes = 0;       ///< of sizes and record together
  uint64_t checksum = 0;    ///< of those bytes
  uint64_t size_count = 0;  ///< file sizes before the record
};

constexpr const char* journal_name = "journal";
constexpr const char* fingerprint_name = "fingerprint";

}  // namespace

WorkFolder::WorkFolder(const std::filesystem::path& pack, const std::string& fingerprint)
    : folder_(pack.string() + ".work") {
  if (std::filesystem::is_directory(pack)) fail(pack.string(), "is a folder, not a file");
  std::error_code error;
  std::filesystem::create_directory(folder_, error);
  if (error) fail(pack.string(), "cannot be written: {}", error.message());
  // A build leaves nothing without its lock: this is somebody else's.
  if (!std::filesystem::exists(file("lock"), error) && !std::filesystem::is_empty(folder_, error))
    fail(folder_.string(), "the build would work in this folder, which holds other files");
  lock_ = ::open(file("lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (lock_ < 0) fail(folder_.string(), "cannot be written: {}", std::strerror(errno));
  if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    ::close(lock_);
    fail(pack.string(), "another process is building it");
  }
  const bool same = !fingerprint.empty() && std::filesystem::exists(file(fingerprint_name), error) &&
                    read_text_file(file(fingerprint_name)) == fingerprint;
  if (same) return;
  if (std::filesystem::exists(file(fingerprint_name), error))
    notice("{}: what another build left is dropped: its files, flags or program were others",
           folder_.string());
  remove_work();
  write_file(file(fingerprint_name), fingerprint);
}

WorkFolder::~WorkFolder() {
  // The lock goes last: whatever is left if this is interrupted is still known to be a build's.
  remove_work();
  std::error_code error;
  std::filesystem::remove(file("lock"), error);
  std::filesystem::remove(folder_, error);
  ::close(lock_);
}

void WorkFolder::remove_work() {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, error)) {
    if (entry.path() != file("lock")) std::filesystem::remove_all(entry.path(), error);
  }
}

BuildJournal::BuildJournal(const WorkFolder& folder)
    : file_(folder.file(journal_name), [&] {
        std::error_code error;
        const uint64_t size = std::filesystem::file_size(folder.file(journal_name), error);
        return error ? 0 : size;
      }()) {
  // What comes next goes right behind the last whole record, or nobody would find it again.
  file_.truncate(read_records());
}

uint64_t BuildJournal::read_records() {
  uint64_t at = 0;
  while (at + sizeof(RecordHeader) <= file_.size()) {
    const auto header =
        ByteReader(file_.read({at, sizeof(RecordHeader)}), file_.path().string()).read<RecordHeader>();
    const uint64_t first = at + sizeof(RecordHeader);
    if (header.bytes > file_.size() - first || header.size_count > header.bytes / sizeof(uint64_t)) break;
    const std::vector<std::byte> bytes = file_.read({first, header.bytes});
    if (hash_bytes(bytes) != header.checksum) break;
    sizes_ = ByteReader(bytes, file_.path().string()).read_all<uint64_t>(header.size_count);
    const uint64_t skipped = header.size_count * sizeof(uint64_t);
    records_.push_back({first + skipped, header.bytes - skipped});
    at = first + header.bytes;
  }
  return at;
}

std::optional<std::vector<std::byte>> BuildJournal::replay() {
  if (next_ == records_.size()) return std::nullopt;
  return file_.read(records_[next_++]);
}

void BuildJournal::append(std::span<const std::byte> record, std::span<const uint64_t> sizes) {
  ByteWriter body;
  body.write_all(sizes);
  body.write_all(record);
  ByteWriter writer;
  writer.write(RecordHeader{body.bytes().size(), hash_bytes(body.bytes()), sizes.size()});
  writer.write_all(std::span<const std::byte>(body.bytes()));
  file_.append(writer.bytes());
}

}  // namespace triptych
