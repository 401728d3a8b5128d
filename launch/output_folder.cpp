#include "launch/output_folder.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/notice.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <fmt/core.h>
#include <sstream>
#include <sys/file.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace triptych {

namespace {

constexpr const char* mark_name = ".triptych-run";
/// The mark begins with this line; then come the command and a line for each picture: name, size, time.
constexpr const char* mark_head = "# pictures of a run of triptych";
/// How long a run that was told to end may take.
constexpr double patience_s = 5;

/// Whether a run gives it its name: "000017.png" (session/pictures.hpp).
bool is_picture(const std::filesystem::path& file) {
  const std::string number = file.stem().string();
  constexpr size_t digits = 6;
  return file.extension() == ".png" && number.size() >= digits &&
         std::all_of(number.begin(), number.end(),
                     [](unsigned char letter) { return std::isdigit(letter) != 0; });
}

std::string state_of(const std::filesystem::path& file) {
  struct stat state {};
  if (::lstat(file.c_str(), &state) != 0) return "";
  return fmt::format("{} {}.{:09}", state.st_size, state.st_mtim.tv_sec, state.st_mtim.tv_nsec);
}

}  // namespace

OutputFolder::OutputFolder(std::filesystem::path folder, const std::string& command)
    : folder_(std::move(folder)), command_(command) {
  made_ = !std::filesystem::exists(folder_);
  make_folder(folder_);
  const std::string file = (folder_ / mark_name).string();
  mark_ = Descriptor(::open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC | O_NOFOLLOW, 0666));
  if (!mark_.is_open()) fail(file, "cannot be written: {}", std::strerror(errno));
  lock();
  earlier_ = read_mark();
  Pictures strangers = pictures();
  for (const auto& [name, state] : left_of_earlier()) strangers.erase(name);
  if (!strangers.empty()) move_aside(strangers);
  write_mark(earlier_);
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  try {
    const auto entries = std::filesystem::directory_iterator(folder_, ignored);
    if (!made_ || std::distance(begin(entries), end(entries)) != 1) {
      write_mark(pictures());
      return;
    }
  } catch (const std::exception&) {
    return;  // the folder is gone, or its disk is full: then no picture is anybody's
  }
  std::filesystem::remove(folder_ / mark_name, ignored);
  std::filesystem::remove(folder_, ignored);
}

void OutputFolder::finish() {
  for (const auto& [name, state] : left_of_earlier()) {
    std::error_code ignored;
    std::filesystem::remove(folder_ / name, ignored);
  }
}

void OutputFolder::share_with_children() const { ::fcntl(mark_.number(), F_SETFD, 0); }

void OutputFolder::lock() const {
  const Stopwatch waiting;
  while (::flock(mark_.number(), LOCK_EX | LOCK_NB) != 0) {
    if (waiting.seconds() > patience_s) {
      std::istringstream mark(read_text_file(folder_ / mark_name));
      std::string line;
      std::getline(mark, line);
      std::getline(mark, line);
      fail(folder_.string(), "another run writes into it ({}): wait for its end, or take another folder",
           line);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

/// The pictures of the mark, if they are the same command's.
OutputFolder::Pictures OutputFolder::read_mark() {
  const std::filesystem::path file = folder_ / mark_name;
  std::istringstream mark(read_text_file(file));
  std::string head, command, line;
  if (!std::getline(mark, head)) return {};
  if (head != mark_head) fail(file.string(), "is no mark of a run, and would be lost: take another folder");
  std::getline(mark, command);
  Pictures pictures;
  while (command == command_ && std::getline(mark, line)) {
    const size_t end = line.find(' ');
    if (end != std::string::npos) pictures[line.substr(0, end)] = line.substr(end + 1);
  }
  return pictures;
}

void OutputFolder::write_mark(const Pictures& pictures) const {
  const std::string file = (folder_ / mark_name).string();
  std::string text = fmt::format("{}\n{}\n", mark_head, command_);
  for (const auto& [name, state] : pictures) text += fmt::format("{} {}\n", name, state);
  if (::ftruncate(mark_.number(), 0) != 0 || ::lseek(mark_.number(), 0, SEEK_SET) != 0)
    fail(file, "cannot be written: {}", std::strerror(errno));
  write_all(mark_.number(), std::as_bytes(std::span(text)), file);
}

OutputFolder::Pictures OutputFolder::pictures() const {
  Pictures found;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    if (std::filesystem::is_regular_file(entry.symlink_status()) && is_picture(entry.path()))
      found[entry.path().filename().string()] = state_of(entry.path());
  }
  return found;
}

OutputFolder::Pictures OutputFolder::left_of_earlier() const {
  Pictures left;
  for (const auto& [name, state] : earlier_) {
    if (state_of(folder_ / name) == state) left[name] = state;
  }
  return left;
}

void OutputFolder::move_aside(const Pictures& strangers) const {
  std::filesystem::path aside;
  for (int i = 1; aside.empty() || std::filesystem::exists(aside); ++i)
    aside = folder_ / ("earlier-" + std::to_string(i));
  make_folder(aside);
  for (const auto& [name, state] : strangers) std::filesystem::rename(folder_ / name, aside / name);
  notice("{}: {} pictures that are not of this command are now in {}", folder_.string(), strangers.size(),
         aside.string());
}

}  // namespace triptych
