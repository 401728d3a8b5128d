#include "session/child_processes.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/notice.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

namespace triptych {

namespace {
constexpr int slice_ms = 100;
constexpr std::string_view complaint_prefix = "triptych: ", record_prefix = "triptych-record: ";
}  // namespace

ChildProcesses::~ChildProcesses() { end_all(std::chrono::milliseconds(1000)); }

pid_t ChildProcesses::start(const std::string& name, const std::vector<std::string>& arguments,
                            Output output) {
  std::vector<std::string> words = {"triptych"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return launch(name, "/proc/self/exe", std::move(words), output, false, "");
}

pid_t ChildProcesses::start_line(const std::string& name, const std::string& line, const std::string& host) {
  return launch(name, "/bin/sh", {"sh", "-c", line}, Output::as_error, true, host);
}

pid_t ChildProcesses::launch(const std::string& name, const char* file, std::vector<std::string> words,
                             Output output, bool own_input, const std::string& host) {
  Pipe errors = open_pipe(name), input;
  Program program{.file = file,
                  .words = std::move(words),
                  .descriptors = {{errors.write.number(), STDERR_FILENO}},
                  .default_signals = {SIGTERM},
                  .ignored_signals = {}};
  if (output == Output::as_error) program.descriptors.push_back({errors.write.number(), STDOUT_FILENO});
  if (own_input) {
    input = open_pipe(name);
    program.descriptors.push_back({input.read.number(), STDIN_FILENO});
    // A terminal's signals are for this program only: the child must keep relaying the other machine's output
    // until that ends.
    program.ignored_signals = {SIGHUP, SIGINT};
  } else {
    program.default_signals.push_back(SIGINT);
  }
  const pid_t pid = start_program(program, name);
  children_.push_back({.name = name,
                       .pid = pid,
                       .errors = std::move(errors.read),
                       .input = std::move(input.write),
                       .by_line = own_input,
                       .host = host});
  return pid;
}

void ChildProcesses::close_inputs() {
  for (Child& child : children_) child.input.close();
}

std::vector<std::string> ChildProcesses::records(const std::string& name) const {
  std::vector<std::string> records;
  for (const Child& child : children_) {
    if (child.name == name && !child.record.empty()) records.push_back(child.record);
  }
  return records;
}

void ChildProcesses::take_lines(Child& child, const char* characters, size_t count) {
  child.line.append(characters, count);
  for (size_t end; (end = child.line.find('\n')) != std::string::npos; child.line.erase(0, end + 1)) {
    const std::string line = child.line.substr(0, end);
    if (line.starts_with(complaint_prefix)) {
      child.complaint = line.substr(complaint_prefix.size());
    } else if (line.starts_with(record_prefix)) {
      child.record = line.substr(record_prefix.size());
    } else {
      if (child.by_line && !line.empty()) child.said_last = line;
      if (child.by_line) {
        notice("{} on {}: {}", child.name, child.host, line);
      } else {
        notice("{}", line);
      }
    }
  }
}

void ChildProcesses::read_errors(int timeout_ms) {
  std::vector<pollfd> waiting;
  for (const Child& child : children_)
    waiting.push_back({.fd = child.errors.number(), .events = POLLIN, .revents = 0});
  if (::poll(waiting.data(), waiting.size(), timeout_ms) <= 0) return;
  for (size_t i = 0; i < waiting.size(); ++i) {
    if (waiting[i].revents == 0) continue;
    std::array<char, 4096> buffer{};
    const ssize_t count = ::read(children_[i].errors.number(), buffer.data(), buffer.size());
    if (count > 0) {
      take_lines(children_[i], buffer.data(), static_cast<size_t>(count));
    } else {
      children_[i].errors.close();  // poll ignores negative descriptors
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
  // Closing its input reaches a program on another machine; a signal would only reach the local command.
  const bool beyond = std::any_of(children_.begin(), children_.end(),
                                  [](const Child& child) { return child.running && child.input.is_open(); });
  close_inputs();
  for (const Stopwatch stopwatch;
       beyond && any_running() && stopwatch.milliseconds() < static_cast<double>(grace.count());) {
    read_errors(20);
    reap();
  }
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
  if (!child.complaint.empty()) return child.complaint;
  const std::string code = fmt::format("ended with exit code {}", WEXITSTATUS(child.status));
  return child.said_last.empty() ? code : fmt::format("{}; it said: {}", code, child.said_last);
}

void ChildProcesses::read_the_rest(const Child& child) {
  const Stopwatch stopwatch;
  constexpr double limit_ms = 200;  // another process may still hold the pipe
  while (child.errors.is_open() && stopwatch.milliseconds() < limit_ms) read_errors(5);
}

std::string ChildProcesses::place_of(const Child& child) {
  return fmt::format("{}{} (process {})", child.name, child.by_line ? " on " + child.host : "", child.pid);
}

std::optional<ChildProcesses::Ended> ChildProcesses::wait_for_one() {
  reap();
  for (Child& child : children_) {
    if (child.running || child.told) continue;
    child.told = true;
    read_the_rest(child);
    const bool killed = WIFSIGNALED(child.status);
    return Ended{.name = child.name,
                 .place = place_of(child),
                 .pid = child.pid,
                 .signal = killed ? WTERMSIG(child.status) : 0,
                 .exit_code = killed ? 0 : WEXITSTATUS(child.status),
                 .seconds = child.alive.seconds(),
                 .reason = failure(child)};
  }
  read_errors(slice_ms);
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
    // A killed process is the cause of its peers' complaints; otherwise the first complaint is.
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
    fail(place_of(*failed), "{}", failure(*failed));
  }
  return true;
}

}  // namespace triptych
