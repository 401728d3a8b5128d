#include "base/progress.hpp"

#include "base/notice.hpp"

#include <fmt/core.h>
#include <mutex>
#include <unistd.h>

namespace triptych {

namespace {
bool on_terminal() {
  static const bool answer = ::isatty(STDERR_FILENO) != 0;
  return answer;
}
std::mutex& progress_mutex() {
  static std::mutex mutex;
  return mutex;
}
}  // namespace

Progress::Progress(std::string stage, uint64_t total)
    : stage_(std::move(stage)), total_(total), next_print_(on_terminal() ? 0.2 : 5) {}

Progress::~Progress() { print(done_, true); }

void Progress::advance(uint64_t steps) {
  const std::lock_guard lock(progress_mutex());
  done_ += steps;
  if (stopwatch_.seconds() < next_print_) return;
  next_print_ = stopwatch_.seconds() + (on_terminal() ? 0.2 : 5);
  print(done_, false);
}

void Progress::print(uint64_t done, bool last) const {
  const std::string count = total_ ? fmt::format("{}/{}", done, total_) : done ? fmt::format("{}", done) : "";
  const std::string line = fmt::format("{:<28} {:>17} {:8.1f} s", stage_, count, stopwatch_.seconds());
  if (on_terminal()) {
    say(fmt::format("\r\033[K{}{}", line, last ? "\n" : ""));
  } else {
    say(line + "\n");
  }
}

}  // namespace triptych
