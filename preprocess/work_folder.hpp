// Where a build keeps what does not fit in memory, and what it has done so far, so that a killed build can be
// resumed.
#pragma once

#include "base/spool_file.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// The folder `FILE.work` beside the pack FILE. It is removed when the build ends, with or without an error;
/// only a killed process leaves it behind.
class WorkFolder {
 public:
  /// Makes the folder. If an earlier build left one with the same fingerprint (of its input and options), its
  /// journal is kept; everything else in it is removed. An empty fingerprint keeps nothing. Error (path) if
  /// another process is building the same pack, or if the folder is not one that a build left.
  /// An earlier build without one of the files that are needed to go on is dropped as well.
  WorkFolder(const std::filesystem::path& pack, const std::string& fingerprint,
             std::span<const char* const> needed);
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  std::filesystem::path file(const std::string& name) const { return folder_ / name; }

 private:
  /// Keeps an earlier build's work, or starts again.
  void take_over(const std::string& fingerprint, std::span<const char* const> needed);
  /// Removes everything and releases the lock.
  void leave();
  /// Removes everything but the lock. Returns whether nothing else is left.
  bool remove_work();

  std::filesystem::path folder_;
  Descriptor lock_;
};

/// What a build has done, batch after batch. A batch's record is written after everything that the batch
/// wrote elsewhere, together with the sizes of those files.
class BuildJournal {
 public:
  /// Opens the journal and drops a last record that was not written completely.
  explicit BuildJournal(const WorkFolder& folder);

  /// What the files held after the last whole record: the order is the caller's own; empty for a new build.
  const std::vector<KeptBytes>& kept() const { return kept_; }
  /// How many batches an earlier run has done.
  uint64_t replayable() const { return records_.size(); }
  /// The next of them; nullopt once there are no more, and the work has to be done.
  std::optional<std::vector<std::byte>> replay();
  void append(std::span<const std::byte> record, std::span<const KeptBytes> files);

 private:
  /// Returns the file up to the end of the last whole record.
  KeptBytes read_records(const std::filesystem::path& path);

  std::vector<SpoolPlace> records_;
  std::vector<KeptBytes> kept_;
  SpoolFile file_;
  size_t next_ = 0;
};

}  // namespace triptych
