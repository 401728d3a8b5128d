#include "samples/kit/run_writer.hpp"

#include "base/error.hpp"
#include "base/one_line.hpp"
#include "base/process.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>
#include <poll.h>
#include <string_view>
#include <sys/wait.h>
#include <unistd.h>

namespace triptych {

namespace {

/// All that comes until the other end is closed; nothing once stop() is true.
std::optional<std::string> read_all(int descriptor, bool (*stop)()) {
  constexpr int patience_ms = 50;
  std::string text;
  std::array<char, 4096> buffer{};
  for (;;) {
    if (stop && stop()) return std::nullopt;
    pollfd waiting{descriptor, POLLIN, 0};
    if (::poll(&waiting, 1, patience_ms) <= 0) continue;
    const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer.data(), static_cast<size_t>(count));
  }
}

/// The last line that says what is wrong; without one, the last line.
std::string complaint_in(std::string_view said) {
  constexpr std::string_view prefix = "triptych: ";
  std::string complaint, last;
  while (!said.empty()) {
    const std::string_view line = said.substr(0, said.find('\n'));
    said.remove_prefix(std::min(line.size() + 1, said.size()));
    if (line.starts_with(prefix)) complaint = line.substr(prefix.size(), 200);
    if (!line.empty()) last = line.substr(0, 200);
  }
  return one_line(complaint.empty() ? last : complaint);
}

void run(const std::string& what, const std::string& file, std::vector<std::string> words, bool (*stop)()) {
  Pipe said = open_pipe(what);
  words.insert(words.begin(), file);
  const pid_t pid = start_program(
      {.file = file,
       .words = std::move(words),
       .descriptors = {{said.write.number(), STDOUT_FILENO}, {said.write.number(), STDERR_FILENO}},
       .death_signal = SIGKILL,
       .default_signals = {},
       .ignored_signals = {}},
      what);
  said.write.close();
  const std::optional<std::string> text = read_all(said.read.number(), stop);
  if (!text) ::kill(pid, SIGKILL);
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (!text) fail(what, "was told to end while {} wrote it", file);
  if (WIFSIGNALED(status))
    fail(what, "{} crashed (signal {}, {})", file, WTERMSIG(status), ::strsignal(WTERMSIG(status)));
  if (WEXITSTATUS(status) == 0) return;
  const std::string complaint = complaint_in(*text);
  if (complaint.empty()) fail(what, "{} ended with exit code {}", file, WEXITSTATUS(status));
  fail(what, "{}", complaint);
}

}  // namespace

void run_writer(const std::string& what, const std::filesystem::path& program,
                std::vector<std::string> arguments, bool (*stop)()) {
  if (::access(program.c_str(), X_OK) != 0)
    fail(what, "is written by {}, which is not there", program.string());
  run(what, program.string(), std::move(arguments), stop);
}

void run_script(const std::string& what, const std::filesystem::path& script,
                std::vector<std::string> arguments, bool (*stop)()) {
  const std::string node = find_program("node");
  if (node.empty()) fail(what, "is written by a script for Node, which is not installed: run launch/install");
  if (::access(script.c_str(), R_OK) != 0)
    fail(what, "is written by {}, which is not there", script.string());
  arguments.insert(arguments.begin(), script.string());
  run(what, node, std::move(arguments), stop);
}

}  // namespace triptych
