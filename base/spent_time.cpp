#include "base/spent_time.hpp"

#include "base/clock.hpp"
#include "base/threads.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <ctime>
#include <dirent.h>
#include <fcntl.h>
#include <memory>
#include <string_view>
#include <thread>
#include <unistd.h>

namespace triptych {

namespace {

/// The number that the word with this index in the file's first line begins with; 0 where there is none.
double number_in(int folder, const char* file, size_t index) {
  const int descriptor = ::openat(folder, file, O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return 0;
  std::array<char, 512> buffer{};
  const ssize_t size = ::read(descriptor, buffer.data(), buffer.size());
  ::close(descriptor);
  std::string_view text(buffer.data(), static_cast<size_t>(std::max<ssize_t>(size, 0)));
  text = text.substr(0, text.find('\n'));
  for (;; --index) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    if (index == 0 || text.empty()) break;
    text.remove_prefix(std::min(text.find(' '), text.size()));
  }
  double number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

double waiting_milliseconds() {
  const std::unique_ptr<DIR, int (*)(DIR*)> threads(::opendir("/proc/self/task"), &::closedir);
  if (!threads) return 0;
  double nanoseconds = 0;
  while (const dirent* thread = ::readdir(threads.get())) {
    if (thread->d_name[0] == '.') continue;
    std::array<char, 64> name{};
    const std::string_view id(thread->d_name), file("/schedstat");
    if (id.size() + file.size() >= name.size()) continue;
    std::copy(file.begin(), file.end(), std::copy(id.begin(), id.end(), name.begin()));
    nanoseconds += number_in(::dirfd(threads.get()), name.data(), 1);
  }
  return nanoseconds * 1e-6;
}

double stolen_milliseconds() {
  constexpr size_t steal = 8;  // after "cpu"
  return number_in(AT_FDCWD, "/proc/stat", steal) * 1e3 / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

double runnable_threads() {
  constexpr size_t running_of_all = 3;
  return std::max(1.0, number_in(AT_FDCWD, "/proc/loadavg", running_of_all));
}

}  // namespace

double process_cpu_milliseconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

StageWatch::StageWatch() : began_{.wall_ms = steady_milliseconds(), .cpu_ms = process_cpu_milliseconds()} {}

SpentTime StageWatch::spent() const {
  return SpentTime{.wall_ms = steady_milliseconds(), .cpu_ms = process_cpu_milliseconds()} - began_;
}

SpentTime spent_time() {
  return {.wall_ms = steady_milliseconds(),
          .cpu_ms = process_cpu_milliseconds(),
          .waiting_ms = waiting_milliseconds(),
          .stolen_ms = stolen_milliseconds(),
          .runnable = runnable_threads()};
}

SpentTime operator-(const SpentTime& after, const SpentTime& before) {
  return {.wall_ms = std::max(0.0, after.wall_ms - before.wall_ms),
          .cpu_ms = std::max(0.0, after.cpu_ms - before.cpu_ms),
          .waiting_ms = std::max(0.0, after.waiting_ms - before.waiting_ms),
          .stolen_ms = std::max(0.0, after.stolen_ms - before.stolen_ms)};
}

bool is_undisturbed(const SpentTime& before, const SpentTime& after) {
  constexpr double tolerable = 0.02;
  const SpentTime spent = after - before;
  const double cores = std::max(1u, std::thread::hardware_concurrency());
  const double ours = std::min(cores, static_cast<double>(thread_count()));
  return spent.stolen_ms <= 0 && spent.waiting_ms <= tolerable * spent.wall_ms &&
         before.runnable - 1 + ours <= cores && after.runnable <= cores;
}

}  // namespace triptych
