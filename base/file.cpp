#include "base/file.hpp"

#include "base/error.hpp"
#include "base/file_access.hpp"
#include "base/partial_files.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <unistd.h>

namespace triptych {

namespace {
template <typename Container>
Container read_whole(const std::filesystem::path& path) {
  std::FILE* file = ::fdopen(open_to_read(path).release(), "rb");
  if (!file) fail(path.string(), "cannot be opened: {}", std::strerror(errno));
  Container contents;
  char buffer[1 << 16];
  size_t count = 0;
  while ((count = std::fread(buffer, 1, sizeof(buffer), file)) > 0) {
    const auto* first = reinterpret_cast<const typename Container::value_type*>(buffer);
    contents.insert(contents.end(), first, first + count);
  }
  const bool failed = std::ferror(file) != 0;
  std::fclose(file);
  if (failed) fail(path.string(), "cannot be read: {}", std::strerror(errno));
  return contents;
}

/// Names of files to remove if a signal ends the process now. Names that a signal handler has taken out are
/// not freed.
std::array<std::atomic<char*>, 256> unwanted;

size_t note_unwanted(const std::string& name) {
  char* const copy = ::strdup(name.c_str());
  for (size_t i = 0; i < unwanted.size(); ++i) {
    char* empty = nullptr;
    if (unwanted[i].compare_exchange_strong(empty, copy)) return i;
  }
  std::free(copy);
  return unwanted.size();  // with so many at once, this one is left behind when a signal comes
}
void forget_unwanted(size_t& noted) {
  if (noted < unwanted.size()) std::free(unwanted[noted].exchange(nullptr));
  noted = unwanted.size();
}

void end_by_signal(int signal) {
  for (std::atomic<char*>& name : unwanted) {
    if (const char* file = name.exchange(nullptr)) ::unlink(file);
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// A file replaces what has its name; a device or a pipe must not be lost so.
void check_replaceable(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status)) fail(path.string(), "is a folder, not a file");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    fail(path.string(), "is not a regular file, and is not replaced");
}
}  // namespace

std::vector<std::byte> read_file(const std::filesystem::path& path) {
  return read_whole<std::vector<std::byte>>(path);
}
std::string read_text_file(const std::filesystem::path& path) { return read_whole<std::string>(path); }

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) fail(folder.string(), "cannot be made: {}", error.message());
}

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)) {
  check_replaceable(path_);
  remove_forsaken_partial_files_once(path_.parent_path());
  partial_ = partial_name(path_);
  noted_ = note_unwanted(partial_.string());
  file_ = open_partial_file(partial_);
  if (!file_) {
    const int problem = errno;
    forget_unwanted(noted_);
    fail(path_.string(), "cannot be written: {}", std::strerror(problem));
  }
}

AtomicFile::~AtomicFile() {
  forget_unwanted(noted_);
  if (file_) std::fclose(file_);
  if (!partial_.empty()) ::unlink(partial_.c_str());
}

AtomicFile::AtomicFile(std::filesystem::path path, std::filesystem::path partial, const KeptBytes& kept)
    : path_(std::move(path)), partial_(std::move(partial)), noted_(unwanted.size()), size_(kept.size) {
  check_replaceable(path_);
  file_ = std::fopen(partial_.c_str(), kept.size > 0 ? "r+b" : "wb");
  if (!file_) fail(path_.string(), "cannot be written: {}", std::strerror(errno));
  try {
    go_on_behind(kept, ::fileno(file_), hash_, partial_.string());
    if (std::fseek(file_, 0, SEEK_END) != 0)
      fail(path_.string(), "cannot be written: {}", std::strerror(errno));
  } catch (...) {
    std::fclose(file_);
    throw;
  }
}

KeptBytes AtomicFile::flush() {
  if (std::fflush(file_) != 0) fail(path_.string(), "cannot be written: {}", std::strerror(errno));
  return {size_, hash_.checksum()};
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  if (bytes.empty()) return;  // data() may be null
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) {
    fail(path_.string(), "cannot be written: {}", std::strerror(errno));
  }
  size_ += bytes.size();
  hash_.add(bytes);
}

void AtomicFile::write(std::string_view text) { write(std::as_bytes(std::span(text))); }

void AtomicFile::write_at(uint64_t offset, std::span<const std::byte> bytes) {
  if (std::fseek(file_, static_cast<long>(offset), SEEK_SET) != 0 ||
      std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size() ||
      std::fseek(file_, 0, SEEK_END) != 0) {
    fail(path_.string(), "cannot be written: {}", std::strerror(errno));
  }
}

void AtomicFile::commit() {
  const bool flushed = std::fflush(file_) == 0 && ::fsync(::fileno(file_)) == 0;
  if (!flushed) fail(path_.string(), "cannot be written: {}", std::strerror(errno));
  // Open until it has its name: closed, it would look forsaken.
  if (std::rename(partial_.c_str(), path_.c_str()) != 0) {
    fail(path_.string(), "cannot be put in place: {}", std::strerror(errno));
  }
  std::fclose(file_);
  file_ = nullptr;
  forget_unwanted(noted_);
  partial_.clear();
}

void remove_partial_files_on_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
    if (std::signal(signal, end_by_signal) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace triptych
