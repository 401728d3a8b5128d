#include "base/process.hpp"

#include "base/error.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/prctl.h>
#include <unistd.h>

namespace triptych {

namespace {

/// Keeps signals waiting while a child is made: one that comes before its program has begun is the child's
/// own, and not lost on the handlers of its starter.
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
  // From here on only what is safe between fork and exec: other threads' locks stay as they were.
  ::prctl(PR_SET_PDEATHSIG, program.death_signal);
  if (::getppid() != parent) ::_exit(1);  // the parent died before the line above
  // All are moved out of the way first, so that none lands on another.
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
