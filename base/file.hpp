// Files: whole reads, and writes that appear under their name only when they are finished.
#pragma once

#include "base/kept_bytes.hpp"

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace triptych {

/// The whole file. Error (place: the path) if it cannot be read or is not a regular file.
std::vector<std::byte> read_file(const std::filesystem::path& path);
std::string read_text_file(const std::filesystem::path& path);

/// Makes the folder and its parents. Error if that fails.
void make_folder(const std::filesystem::path& folder);

/// A file that is written beside its name and renamed by commit(); destroyed without commit, it leaves
/// nothing.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  /// Written under the name `partial` until commit(); what was kept of an earlier one stays. Error (partial)
  /// if it holds something else.
  AtomicFile(std::filesystem::path path, std::filesystem::path partial, const KeptBytes& kept);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::span<const std::byte> bytes);
  void write(std::string_view text);
  /// Overwrites bytes at an earlier offset (a header that is known last); further writes still go to the end
  /// of the file.
  void write_at(uint64_t offset, std::span<const std::byte> bytes);
  uint64_t size() const { return size_; }
  /// Hands what was written to the system, so that it survives the end of the process. Returns its size and
  /// checksum, for a later process; without the effect of write_at(). Error if the disk is full.
  KeptBytes flush();
  /// Flushes to the disk and renames. Error if either fails; then nothing is left.
  void commit();

 private:
  std::filesystem::path path_, partial_;
  size_t noted_;  ///< its index in the list of files to remove on a signal
  std::FILE* file_ = nullptr;
  uint64_t size_ = 0;
  StreamHash hash_;
};

/// A signal that ends this process (SIGINT, SIGTERM, SIGHUP, SIGPIPE) removes the AtomicFiles that are not
/// committed, unless it is ignored or another handler is installed later. Those with a given partial name
/// stay, so that a later process can continue them.
void remove_partial_files_on_signals();

void write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace triptych
