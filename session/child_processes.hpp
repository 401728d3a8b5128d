// Processes that this one starts and ends: none is left behind, and their error messages are collected.
#pragma once

#include "base/clock.hpp"
#include "base/process.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace triptych {

/// A group of child processes that end together. Children get SIGTERM when this process dies.
class ChildProcesses {
 public:
  ChildProcesses() = default;
  ~ChildProcesses();  ///< ends all of them
  ChildProcesses(const ChildProcesses&) = delete;
  ChildProcesses& operator=(const ChildProcesses&) = delete;

  /// Where a child's standard output goes.
  enum class Output {
    shared,    ///< to this process's
    as_error,  ///< to its standard error: what it prints is progress here
  };

  /// Starts this program again with other arguments. Its standard error is passed on, except lines that start
  /// with "triptych: ": they are kept as its complaint. Error if it cannot be started.
  pid_t start(const std::string& name, const std::vector<std::string>& arguments,
              Output output = Output::shared);

  /// Starts a line of /bin/sh instead. Its standard input stays open until the children are told to end, so
  /// that it reaches programs on other machines.
  /// host: begins the lines that it prints.
  pid_t start_line(const std::string& name, const std::string& line, const std::string& host);

  /// How a child ended.
  struct Ended {
    std::string name;
    std::string place;  ///< for messages: "switch 0 on b (process 123)"
    pid_t pid = -1;
    int signal = 0;      ///< the one that killed it; 0 for none
    int exit_code = 0;   ///< if no signal killed it
    double seconds = 0;  ///< from its start to its end
    std::string reason;  ///< "was killed by signal 9 (Killed)", or its complaint
  };
  /// The lines that children of this name printed after "triptych-record: ".
  std::vector<std::string> records(const std::string& name) const;
  /// Waits, a tenth of a second at most, until any child ends; each is reported once.
  std::optional<Ended> wait_for_one();
  /// SIGTERM, and SIGKILL for those that do not go within the grace. What they print until then is passed on.
  void end_all(std::chrono::milliseconds grace);

  /// Waits until all have ended. As soon as one fails the others get a moment to leave by themselves and are
  /// ended then; the Error names the first that failed and its complaint. stop: asked a few times a second;
  /// once true, all are told to end, and that is no error. Returns false where it was stopped.
  bool wait(bool (*stop)());

 private:
  struct Child {
    std::string name;
    pid_t pid = -1;
    Descriptor errors;  ///< read end of its standard error
    Descriptor input;   ///< write end of its standard input, if it is a pipe of ours
    bool by_line = false;
    std::string host;  ///< where it runs, of a line of /bin/sh
    std::string line{};
    std::string complaint{}, record{};
    std::string said_last{};  ///< of a line of /bin/sh: ssh's error messages have no prefix
    Stopwatch alive{};
    bool running = true;
    bool told = false;  ///< whether wait_for_one() reported its end
    int status = 0;
  };
  pid_t launch(const std::string& name, const char* file, std::vector<std::string> words, Output output,
               bool own_input, const std::string& host);
  void close_inputs();
  void read_errors(int timeout_ms);
  void take_lines(Child& child, const char* characters, size_t count);
  /// Collects children that ended; returns the first of them that failed.
  Child* reap();
  bool any_running() const;
  void signal_all(int signal);
  /// Reads what an ended child printed last.
  void read_the_rest(const Child& child);
  static std::string failure(const Child& child);
  static std::string place_of(const Child& child);

  std::vector<Child> children_;
};

}  // namespace triptych
