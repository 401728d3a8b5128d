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

/// Whether a run gives it its name: "000017.png" (session/pictures.hpp).
bool is_picture(const std::filesystem::path& file) {
  const std::string number = file.stem().string();
  constexpr size_t digits = 6;
  return file.extension() == ".png" && number.size() >= digits &&
         std::all_of(number.begin(), number.end(),
                     [](unsigned char letter) { return std::isdigit(letter) != 0; });
}

}  // namespace

OutputFolder::OutputFolder(std::filesystem::path folder, const std::string& command)
    : folder_(std::move(folder)) {
  made_ = !std::filesystem::exists(folder_);
  make_folder(folder_);
  const bool same_command = claim(command) == command;
  const std::vector<std::filesystem::path> old = pictures();
  if (same_command) {
    for (const auto& file : old) old_[file] = std::filesystem::last_write_time(file);
  } else if (!old.empty()) {
    move_aside(old);
  }
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  const auto is_old = [&](const std::filesystem::path& file) {
    const auto found = old_.find(file);
    return found != old_.end() && found->second == std::filesystem::last_write_time(file, ignored);
  };
  try {
    const std::vector<std::filesystem::path> now = pictures();
    if (std::all_of(now.begin(), now.end(), is_old) && !now.empty()) return;  // the run came to nothing
    for (const auto& file : now) {
      if (is_old(file)) std::filesystem::remove(file, ignored);
    }
    const auto entries = std::filesystem::directory_iterator(folder_, ignored);
    if (!made_ || std::distance(begin(entries), end(entries)) != 1) return;
  } catch (const std::filesystem::filesystem_error&) {
    return;  // the folder is gone
  }
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

std::vector<std::filesystem::path> OutputFolder::pictures() const {
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    if (entry.is_regular_file() && is_picture(entry.path())) found.push_back(entry.path());
  }
  return found;
}

void OutputFolder::move_aside(const std::vector<std::filesystem::path>& old) const {
  std::filesystem::path aside;
  for (int i = 1; aside.empty() || std::filesystem::exists(aside); ++i)
    aside = folder_ / ("earlier-" + std::to_string(i));
  make_folder(aside);
  for (const auto& file : old) std::filesystem::rename(file, aside / file.filename());
  notice("{}: {} pictures of an earlier run are now in {}", folder_.string(), old.size(), aside.string());
}

}  // namespace triptych
