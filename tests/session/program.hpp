// The program `triptych` as a user starts it: runs to its end, or in the background.
#pragma once

#include <algorithm>
#include <chrono>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <signal.h>
#include <sstream>
#include <stdexcept>
#include <string>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace triptych::test {

/// A folder of the running test's own; empty at first, gone at the end.
class Folder {
 public:
  Folder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name =
        "triptych_" + std::to_string(::getpid()) + "_" + test->test_suite_name() + "_" + test->name();
    std::replace(name.begin(), name.end(), '/', '_');
    path_ = std::filesystem::path(testing::TempDir()) / name;
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;  // the next run has another name
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  size_t files() const {
    return static_cast<size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

 private:
  std::filesystem::path path_;
};

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline nlohmann::json json_of(const std::filesystem::path& file) {
  return nlohmann::json::parse(text_of(file));
}

/// One run of the program. Its process group goes with it, so that nothing outlives a failed test.
class Program {
 public:
  explicit Program(std::vector<std::string> arguments) {
    static int runs = 0;
    log_ = std::filesystem::path(testing::TempDir()) /
           ("triptych_" + std::to_string(::getpid()) + "_" + std::to_string(runs++) + ".log");
    std::vector<char*> words;
    std::string name = TRIPTYCH_PROGRAM;
    // Otherwise a check that waits for a failure would take this one for it.
    if (::access(name.c_str(), X_OK) != 0) throw std::runtime_error(name + ": cannot be run: build it first");
    words.push_back(name.data());
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ == 0) {
      ::setpgid(0, 0);
      ::prctl(PR_SET_PDEATHSIG, SIGTERM);
      const int log = ::open(log_.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
      ::dup2(log, STDERR_FILENO);
      ::dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO);
      ::execv(name.c_str(), words.data());
      ::_exit(127);
    }
  }
  ~Program() {
    if (!ended_) {
      ::kill(-pid_, SIGKILL);
      ::waitpid(pid_, nullptr, 0);
    }
    std::error_code ignored;
    std::filesystem::remove(log_, ignored);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Waits for the end: the exit code, or minus the signal. −1000 where it does not end in time.
  int wait(std::chrono::seconds limit = std::chrono::seconds(240)) {
    const auto give_up = std::chrono::steady_clock::now() + limit;
    while (!ended_) {
      int status = 0;
      if (::wait4(pid_, &status, WNOHANG, &usage_) == pid_) {
        ended_ = true;
        code_ = WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
      } else if (std::chrono::steady_clock::now() > give_up) {
        return -1000;
      } else {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
    }
    return code_;
  }

  /// Of the run, when it has ended: the largest resident size that it or a child of its own had.
  uint64_t peak_bytes() const { return static_cast<uint64_t>(usage_.ru_maxrss) * 1024; }

  void signal(int number) const { ::kill(pid_, number); }
  pid_t pid() const { return pid_; }

  /// Standard error so far.
  std::string errors() const { return text_of(log_); }
  std::vector<std::string> complaints() const {
    std::istringstream in(errors());
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) {
      if (line.starts_with("triptych: ")) lines.push_back(line);
    }
    return lines;
  }

  /// The process that plays the role, as it is said at the start ("role switch 0 is process 123"); waits for
  /// that line.
  pid_t role(const std::string& name) const {
    const std::string start = "role " + name + " is process ";
    for (int tries = 0; tries < 4000; ++tries) {
      const std::string text = errors();
      const size_t found = text.find(start);
      if (found != std::string::npos && text.find('\n', found) != std::string::npos) {
        return static_cast<pid_t>(std::stol(text.substr(found + start.size())));
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ADD_FAILURE() << "no role " << name << " was started: " << errors();
    return 0;
  }

  /// The process that plays the role now: the last that was said.
  pid_t last_role(const std::string& name) const {
    const std::string start = "role " + name + " is process ";
    const std::string text = errors();
    const size_t found = text.rfind(start);
    return found == std::string::npos ? role(name)
                                      : static_cast<pid_t>(std::stol(text.substr(found + start.size())));
  }

  /// Whether any process of this run is left. Zombies that nobody has collected yet do not count.
  bool anybody_left() const {
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
      const std::string id = entry.path().filename();
      if (id.find_first_not_of("0123456789") != std::string::npos) continue;
      std::ostringstream text;
      text << std::ifstream(entry.path() / "stat")
                  .rdbuf();  // nothing, where the process ends while it is read
      const std::string stat = text.str();
      const size_t name_end = stat.rfind(')');
      if (name_end == std::string::npos) continue;
      std::istringstream fields(stat.substr(name_end + 1));
      char state = 0;
      pid_t parent = 0, group = 0;
      fields >> state >> parent >> group;
      if (group == pid_ && state != 'Z' && state != 'X') return true;
    }
    return false;
  }

 private:
  pid_t pid_ = -1;
  std::filesystem::path log_;
  bool ended_ = false;
  int code_ = 0;
  rusage usage_{};
};

/// Runs to the end and expects exit 0.
inline void run(std::vector<std::string> arguments) {
  Program program(std::move(arguments));
  ASSERT_EQ(program.wait(), 0) << program.errors();
}

/// Runs to the end and expects one clear line, exit 1, and nobody left.
inline std::string failure(std::vector<std::string> arguments) {
  Program program(std::move(arguments));
  EXPECT_EQ(program.wait(), 1) << program.errors();
  const auto complaints = program.complaints();
  EXPECT_EQ(complaints.size(), 1u) << program.errors();
  EXPECT_FALSE(program.anybody_left());
  return complaints.empty() ? "" : complaints.back();
}

}  // namespace triptych::test
