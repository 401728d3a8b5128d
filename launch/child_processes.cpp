#include "launch/child_processes.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/notice.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace triptych {

namespace {
constexpr int slice_ms = 100;
constexpr std::string_view complaint_prefix = "triptych: ";
}  // namespace

ChildProcesses::~ChildProcesses() {
  end_all(std::chrono::milliseconds(1000));
  for (const Child& child : children_) {
    if (child.errors >= 0) ::close(child.errors);
  }
}

pid_t ChildProcesses::start(const std::string& name, const std::vector<std::string>& arguments,
                            Output output) {
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) fail(name, "cannot be started: {}", std::strerror(errno));
  std::vector<char*> words;
  std::string program = "triptych";
  words.push_back(program.data());
  std::vector<std::string> copies = arguments;
  for (std::string& copy : copies) words.push_back(copy.data());
  words.push_back(nullptr);
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid < 0) {
    ::close(pipe[0]);
    ::close(pipe[1]);
    fail(name, "cannot be started: {}", std::strerror(errno));
  }
  if (pid == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent) ::_exit(1);  // the parent died before the line above
    ::dup2(pipe[1], STDERR_FILENO);
    if (output == Output::as_error) ::dup2(pipe[1], STDOUT_FILENO);
    ::execv("/proc/self/exe", words.data());
    ::_exit(127);
  }
  ::close(pipe[1]);
  children_.push_back({.name = name, .pid = pid, .errors = pipe[0], .line = {}, .complaint = {}});
  return pid;
}

void ChildProcesses::take_lines(Child& child, const char* characters, size_t count) {
  child.line.append(characters, count);
  for (size_t end; (end = child.line.find('\n')) != std::string::npos; child.line.erase(0, end + 1)) {
    const std::string line = child.line.substr(0, end);
    if (line.starts_with(complaint_prefix)) {
      child.complaint = line.substr(complaint_prefix.size());
    } else {
      notice("{}", line);
    }
  }
}

void ChildProcesses::read_errors(int timeout_ms) {
  std::vector<pollfd> waiting;
  for (const Child& child : children_)
    waiting.push_back({.fd = child.errors, .events = POLLIN, .revents = 0});
  if (::poll(waiting.data(), waiting.size(), timeout_ms) <= 0) return;
  for (size_t i = 0; i < waiting.size(); ++i) {
    if (waiting[i].revents == 0) continue;
    std::array<char, 4096> buffer{};
    const ssize_t count = ::read(children_[i].errors, buffer.data(), buffer.size());
    if (count > 0) {
      take_lines(children_[i], buffer.data(), static_cast<size_t>(count));
    } else {
      ::close(children_[i].errors);
      children_[i].errors = -1;  // poll passes negative descriptors over
    }
  }
}

ChildProcesses::Child* ChildProcesses::reap() {
  Child* failed = nullptr;
  for (Child& child : children_) {
    if (!child.running || ::waitpid(child.pid, &child.status, WNOHANG) != child.pid) continue;
    child.running = false;
    if (child.status != 0 && !failed) failed = &child;
  }
  return failed;
}

bool ChildProcesses::any_running() const {
  for (const Child& child : children_) {
    if (child.running) return true;
  }
  return false;
}

void ChildProcesses::signal_all(int signal) {
  for (const Child& child : children_) {
    if (child.running) ::kill(child.pid, signal);
  }
}

void ChildProcesses::end_all(std::chrono::milliseconds grace) {
  signal_all(SIGTERM);
  const Stopwatch stopwatch;
  while (any_running() && stopwatch.milliseconds() < static_cast<double>(grace.count())) {
    read_errors(20);
    reap();
  }
  signal_all(SIGKILL);
  while (any_running()) {
    read_errors(5);
    reap();
  }
}

std::string ChildProcesses::failure(const Child& child) {
  if (WIFSIGNALED(child.status)) {
    return fmt::format("was killed by signal {} ({})", WTERMSIG(child.status),
                       ::strsignal(WTERMSIG(child.status)));
  }
  return child.complaint.empty() ? fmt::format("ended with exit code {}", WEXITSTATUS(child.status))
                                 : child.complaint;
}

void ChildProcesses::read_the_rest(const Child& child) {
  const Stopwatch stopwatch;
  constexpr double limit_ms = 200;  // somebody else may hold the pipe
  while (child.errors >= 0 && stopwatch.milliseconds() < limit_ms) read_errors(5);
}

std::optional<ChildProcesses::Ended> ChildProcesses::wait_for_one(bool (*stop)()) {
  while (!stop()) {
    reap();
    for (Child& child : children_) {
      if (child.running || child.told) continue;
      child.told = true;
      read_the_rest(child);
      const bool killed = WIFSIGNALED(child.status);
      return Ended{child.name, child.pid, killed ? WTERMSIG(child.status) : 0,
                   killed ? 0 : WEXITSTATUS(child.status), failure(child)};
    }
    read_errors(slice_ms);
  }
  return std::nullopt;
}

bool ChildProcesses::wait(bool (*stop)()) {
  while (any_running()) {
    if (stop()) {
      end_all(std::chrono::milliseconds(1000));
      return false;
    }
    read_errors(slice_ms);
    const Child* failed = reap();
    if (!failed) continue;
    // A killed process is the cause of what its peers complain about; of complaints the first is.
    const Stopwatch grace;
    constexpr double grace_ms = 2000;
    while (any_running() && grace.milliseconds() < grace_ms) {
      read_errors(slice_ms);
      reap();
    }
    end_all(std::chrono::milliseconds(1000));
    read_errors(0);
    for (const Child& child : children_) {
      if (WIFSIGNALED(child.status) && WTERMSIG(child.status) != SIGTERM) failed = &child;
    }
    fail(fmt::format("{} (process {})", failed->name, failed->pid), "{}", failure(*failed));
  }
  return true;
}

}  // namespace triptych
