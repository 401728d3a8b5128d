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

/// The whole file. Error (place: the path) if it cannot be read, or is no regular file.
std::vector<std::byte> read_file(const std::filesystem::path& path);
std::string read_text_file(const std::filesystem::path& path);

/// Makes the folder and its parents. Error if that fails.
void make_folder(const std::filesystem::path& folder);

/// A file that is written beside its name and renamed by commit(); destroyed without commit, it leaves
/// nothing.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  /// Written under the given name until commit(); what was kept of it stays. Error (partial) if it holds
  /// something else.
  AtomicFile(std::filesystem::path path, std::filesystem::path partial, const KeptBytes& kept);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::span<const std::byte> bytes);
  void write(std::string_view text);
  /// Overwrites bytes at an earlier offset (a header that is known last); the end of the file stays the place
  /// to write.
  void write_at(uint64_t offset, std::span<const std::byte> bytes);
  uint64_t size() const { return size_; }
  /// Hands what was written to the system: it survives the end of the process. Returns it all, for a later
  /// process; write_at() is not counted in. Error if the disk is full.
  KeptBytes flush();
  /// Flushes to the disk and renames. Error if either fails; then nothing is left.
  void commit();

 private:
  std::filesystem::path path_, partial_;
  size_t noted_;  ///< where its name stands for signals
  std::FILE* file_ = nullptr;
  uint64_t size_ = 0;
  StreamHash hash_;
};

/// A signal that ends this process (SIGINT, SIGTERM, SIGHUP, SIGPIPE) takes the AtomicFiles with it that are
/// not committed, unless it is ignored or somebody handles it later. Those with a name of their own stay: who
/// gave it goes on with them.
void remove_partial_files_on_signals();

void write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace triptych
