// A display of the test's own, without a screen, and a person at its keyboard and mouse.
#pragma once

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <string>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace triptych::test {

/// Xvfb with a free number, in DISPLAY as long as this lives. It stays as it is when its last window has
/// gone: while it resets itself, as it would, nobody gets in.
class Display {
 public:
  Display() {
    std::array<int, 2> pipe{};
    if (::pipe(pipe.data()) != 0) return;
    pid_ = ::fork();
    if (pid_ == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGTERM);
      ::close(pipe[0]);
      ::dup2(::open("/dev/null", O_WRONLY), STDERR_FILENO);
      const std::string descriptor = std::to_string(pipe[1]);
      ::execlp("Xvfb", "Xvfb", "-displayfd", descriptor.c_str(), "-screen", "0", "800x600x24", "-noreset",
               "-nolisten", "tcp", nullptr);
      ::_exit(127);
    }
    ::close(pipe[1]);
    std::string number;
    for (char character = 0; ::read(pipe[0], &character, 1) == 1 && character != '\n';) number += character;
    ::close(pipe[0]);
    EXPECT_FALSE(number.empty()) << "Xvfb does not start";
    ::setenv("DISPLAY", (":" + number).c_str(), 1);
  }
  ~Display() {
    ::unsetenv("DISPLAY");
    if (pid_ <= 0) return;
    ::kill(pid_, SIGTERM);
    ::waitpid(pid_, nullptr, 0);
  }
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;

 private:
  pid_t pid_ = -1;
};

/// What `xdotool ARGUMENTS` prints, without the line's end.
inline std::string xdotool(const std::string& arguments) {
  std::FILE* pipe = ::popen(("timeout 60 xdotool " + arguments + " 2>/dev/null").c_str(), "r");
  if (!pipe) return "";
  std::string text;
  for (int character; (character = std::fgetc(pipe)) != EOF;) text += static_cast<char>(character);
  EXPECT_EQ(::pclose(pipe), 0) << "xdotool " << arguments;
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

}  // namespace triptych::test
