#include "base/process.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <string_view>
#include <sys/prctl.h>
#include <unistd.h>

namespace triptych {

namespace {

/// Blocks signals while a child is made, so that one that comes before the child's program has begun is
/// handled by that program, not by this program's handlers.
class SignalsHeld {
 public:
  SignalsHeld() {
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsHeld() { release(); }
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;
  void release() const { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_{};
};

}  // namespace

Pipe open_pipe(const std::string& place) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail(place, "cannot have a pipe: {}", std::strerror(errno));
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

std::string find_program(const std::string& name) {
  const char* const path = std::getenv("PATH");
  std::string_view left = path ? path : "/usr/local/bin:/usr/bin:/bin";
  while (!left.empty()) {
    const size_t end = std::min(left.find(':'), left.size());
    std::string file = std::string(left.substr(0, end)) + "/" + name;
    if (end > 0 && ::access(file.c_str(), X_OK) == 0) return file;
    left.remove_prefix(std::min(end + 1, left.size()));
  }
  return "";
}

pid_t start_program(const Program& program, const std::string& place) {
  std::vector<std::string> words = program.words;
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  std::vector<int> copies(program.descriptors.size());
  const pid_t parent = ::getpid();
  const SignalsHeld held;
  const pid_t pid = ::fork();
  if (pid < 0) fail(place, "cannot be started: {}", std::strerror(errno));
  if (pid > 0) return pid;
  // From here on only calls that are safe between fork and exec: locks of other threads are never released
  // here.
  ::prctl(PR_SET_PDEATHSIG, program.death_signal);
  if (::getppid() != parent) ::_exit(1);  // the parent died before the line above
  // All are duplicated to free numbers first, so that none overwrites another.
  for (size_t i = 0; i < copies.size(); ++i)
    copies[i] = ::fcntl(program.descriptors[i].ours, F_DUPFD_CLOEXEC, 10);
  for (size_t i = 0; i < copies.size(); ++i) ::dup2(copies[i], program.descriptors[i].theirs);
  for (const int signal : program.default_signals) ::signal(signal, SIG_DFL);
  for (const int signal : program.ignored_signals) ::signal(signal, SIG_IGN);
  held.release();
  ::execv(program.file.c_str(), pointers.data());
  ::_exit(127);
}

}  // namespace triptych
