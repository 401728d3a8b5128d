#include "launch/output_folder.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/notice.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <vector>

namespace triptych {

namespace {

constexpr const char* mark_name = ".triptych-run";

bool is_picture(const std::filesystem::path& file) {
  const std::string number = file.stem().string();
  constexpr size_t digits = 6;
  return file.extension() == ".png" && number.size() >= digits &&
         std::all_of(number.begin(), number.end(),
                     [](unsigned char letter) { return std::isdigit(letter) != 0; });
}

bool is_one_of(Written written, const std::filesystem::path& file) {
  return (written != Written::recordings && is_picture(file)) ||
         (written != Written::pictures && file.extension() == ".recording");
}

}  // namespace

OutputFolder::OutputFolder(std::filesystem::path folder, Written written, const std::string& command)
    : folder_(std::move(folder)) {
  made_ = !std::filesystem::exists(folder_);
  make_folder(folder_);
  clear(written, claim(command) == command);
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  const auto entries = std::filesystem::directory_iterator(folder_, ignored);
  if (!made_ || std::distance(begin(entries), end(entries)) != 1) return;
  std::filesystem::remove(folder_ / mark_name, ignored);
  std::filesystem::remove(folder_, ignored);
}

/// Locks the mark and writes the command into it; returns that of the run before.
std::string OutputFolder::claim(const std::string& command) {
  const std::string file = (folder_ / mark_name).string();
  mark_ = Descriptor(::open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666));
  if (!mark_.is_open()) fail(file, "cannot be written: {}", std::strerror(errno));
  if (::flock(mark_.number(), LOCK_EX | LOCK_NB) != 0)
    fail(folder_.string(), "another run writes into it ({}): wait for its end, or take another folder",
         read_text_file(file));
  std::vector<std::byte> before(size_of(mark_.number(), file));
  read_at(mark_.number(), 0, before, file);
  if (::ftruncate(mark_.number(), 0) != 0) fail(file, "cannot be written: {}", std::strerror(errno));
  write_all(mark_.number(), std::as_bytes(std::span(command)), file);
  return {reinterpret_cast<const char*>(before.data()), before.size()};
}

void OutputFolder::clear(Written written, bool same_command) const {
  std::vector<std::filesystem::path> old;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    if (entry.is_regular_file() && is_one_of(written, entry.path())) old.push_back(entry.path());
  }
  if (old.empty()) return;
  std::filesystem::path aside;
  for (int i = 1; aside.empty() || std::filesystem::exists(aside); ++i)
    aside = folder_ / ("earlier-" + std::to_string(i));
  if (!same_command) {
    make_folder(aside);
    notice("{}: {} files of an earlier run are now in {}", folder_.string(), old.size(), aside.string());
  }
  for (const auto& file : old)
    same_command ? static_cast<void>(std::filesystem::remove(file))
                 : std::filesystem::rename(file, aside / file.filename());
}

}  // namespace triptych
