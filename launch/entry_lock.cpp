#include "launch/entry_lock.hpp"

#include "base/error.hpp"
#include "base/notice.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <fmt/ranges.h>
#include <fstream>
#include <sstream>
#include <sys/file.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace triptych {

namespace {

/// 'R' for running, 'S' for sleeping, 'T' for stopped …, as the kernel says (proc(5)); 0 for one that is
/// gone.
char state_of(pid_t process) {
  std::ifstream file(fmt::format("/proc/{}/stat", process));
  std::string stat;
  std::getline(file, stat);
  const size_t name_end = stat.rfind(") ");
  if (name_end == std::string::npos || name_end + 2 >= stat.size()) return 0;
  const char state = stat[name_end + 2];
  return state == 'Z' || state == 'X' ? '\0' : state;
}

}  // namespace

EntryLock::EntryLock(const std::filesystem::path& entry) : file_name_((entry / name).string()) {
  file_ = Descriptor(::open(file_name_.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666));
  // What is ready may be used from a folder that cannot be written.
  if (!file_.is_open()) file_ = Descriptor(::open(file_name_.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file_.is_open()) fail(file_name_, "cannot be opened: {}", std::strerror(errno));
}

bool EntryLock::try_now() const {
  if (::flock(file_.number(), LOCK_EX | LOCK_NB) == 0) return true;
  if (errno != EWOULDBLOCK && errno != EINTR) fail(file_name_, "cannot be locked: {}", std::strerror(errno));
  return false;
}

bool EntryLock::is_there() const {
  struct stat locked {
  }, named{};
  return ::fstat(file_.number(), &locked) == 0 && ::stat(file_name_.c_str(), &named) == 0 &&
         locked.st_dev == named.st_dev && locked.st_ino == named.st_ino;
}

/// Those that build the entry and live, in words.
std::string EntryLock::holders() const {
  std::array<char, 64> text{};
  const ssize_t size = ::pread(file_.number(), text.data(), text.size() - 1, 0);
  std::istringstream numbers(std::string(text.data(), static_cast<size_t>(std::max<ssize_t>(size, 0))));
  std::vector<pid_t> living;
  bool stopped = false;
  for (pid_t process = 0; numbers >> process;) {
    const char state = state_of(process);
    if (state == 0) continue;
    living.push_back(process);
    stopped = stopped || state == 'T';
  }
  if (living.empty()) return "another process looks at this pack; waiting for it";
  const std::string who = fmt::format("{}", fmt::join(living, " "));
  const bool several = living.size() > 1;
  if (!stopped)
    return fmt::format("process{} {} build{} this pack; waiting (Ctrl+C gives up)", several ? "es" : "", who,
                       several ? "" : "s");
  return fmt::format(
      "process{0} {1}, which build{2} this pack, {3} stopped; waiting (kill -CONT {1} lets {4} go on; kill "
      "-KILL {1}, "
      "and it is built here; Ctrl+C gives up)",
      several ? "es" : "", who, several ? "" : "s", several ? "are" : "is", several ? "them" : "it");
}

void EntryLock::wait() const {
  const std::string entry = std::filesystem::path(file_name_).parent_path().string();
  for (std::string said; !try_now(); std::this_thread::sleep_for(std::chrono::milliseconds(100))) {
    const std::string now = holders();
    if (now != said) notice("{}: {}", entry, now);
    said = now;
  }
}

void EntryLock::note_use() const { ::futimens(file_.number(), nullptr); }

EntryLock::Shared::Shared(const EntryLock& lock) : lock_(lock) { ::fcntl(lock.file_.number(), F_SETFD, 0); }

EntryLock::Shared::~Shared() {
  ::fcntl(lock_.file_.number(), F_SETFD, FD_CLOEXEC);
  [[maybe_unused]] const int done = ::ftruncate(lock_.file_.number(), 0);
}

void EntryLock::Shared::note_builder(pid_t builder) const {
  const std::string text = fmt::format("{} {}\n", ::getpid(), builder);
  // Where that fails, those who wait are told less.
  [[maybe_unused]] const int cleared = ::ftruncate(lock_.file_.number(), 0);
  [[maybe_unused]] const ssize_t written = ::pwrite(lock_.file_.number(), text.data(), text.size(), 0);
}

}  // namespace triptych
