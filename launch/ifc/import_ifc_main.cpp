// triptych-import-ifc: reads one IFC file and writes a scene stream to descriptor 3 (docs/formats.md). It
// limits itself, and becomes Node, which runs web-ifc (read_ifc.mjs). triptych starts it
// (model/import/converter.hpp).
#include "base/error.hpp"
#include "base/process.hpp"
#include "launch/reader_limits.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <future>
#include <string>
#include <string_view>
#include <sys/mman.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <vector>

namespace triptych {

namespace {

constexpr std::string_view name = "triptych-import-ifc";

/// The scripts and web-ifc: beside this program, in the build folder as where it is installed.
std::filesystem::path reader_folder() {
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  return program.parent_path().parent_path() / "share/triptych/ifc";
}

/// The word that the script writes the number of each product to before it has it read; 0 between them.
class CurrentProduct {
 public:
  CurrentProduct() : word_(::memfd_create("current product", MFD_CLOEXEC)) {
    if (!word_.is_open()) fail("IFC", "its reader cannot be watched: {}", std::strerror(errno));
  }
  int descriptor() const { return word_.number(); }
  uint32_t number() const {
    uint32_t number = 0;
    return ::pread(word_.number(), &number, sizeof(number), 0) == sizeof(number) ? number : 0;
  }

 private:
  Descriptor word_;
};

/// Node waits forever for threads that it could not start. Error where it would.
void check_threads() {
  constexpr size_t of_node = 12;
  std::promise<void> over;
  const std::shared_future<void> end = over.get_future().share();
  std::vector<std::thread> threads;
  bool all = true;
  try {
    while (threads.size() < of_node) threads.emplace_back([end] { end.wait(); });
  } catch (const std::system_error&) {
    all = false;
  }
  over.set_value();
  for (std::thread& thread : threads) thread.join();
  if (!all)
    fail("Node", "needs {} threads, and no more can be started: processes (ulimit -u) are too limited",
         of_node);
}

Program node_program(uint64_t memory, const std::string& file, int current) {
  const std::string node = find_program("node");
  if (node.empty())
    fail("IFC", "is read by Node, which is not installed: run launch/install, or apt-get install nodejs");
  const std::filesystem::path folder = reader_folder();
  if (!std::filesystem::exists(folder / "node_modules/web-ifc/web-ifc-node.wasm"))
    fail("IFC", "is read by web-ifc, which is not there: run launch/install, or npm ci in {}",
         folder.string());
  // Most of the memory is WebAssembly's; the heap of objects needs its share.
  const std::string heap = fmt::format("--max-old-space-size={}", std::max<uint64_t>(memory >> 21, 64));
  return {.file = node,
          .words = {node, heap, (folder / "read_ifc.mjs").string(), file},
          .descriptors = {{3, 3}, {current, 5}, {STDERR_FILENO, STDOUT_FILENO}},
          .death_signal = SIGKILL,
          .default_signals = {},
          .ignored_signals = {}};
}

/// Seconds of the processor that the process has taken; those of the wall also count what others run.
double cpu_seconds(pid_t pid) {
  clockid_t clock{};
  timespec time{};
  if (::clock_getcpuclockid(pid, &clock) != 0 || ::clock_gettime(clock, &time) != 0) return 0;
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) / 1e9;
}

/// Its status when it has ended, also because it was killed for spending so many seconds on one product.
int wait_for(pid_t pid, const CurrentProduct& current, double patience) {
  uint32_t last = 0;
  for (double begun = 0;;) {
    int status = 0;
    if (::waitpid(pid, &status, WNOHANG) == pid) return status;
    ::usleep(5000);
    const double now = cpu_seconds(pid);
    if (const uint32_t product = current.number(); product != last || product == 0) {
      last = product;
      begun = now;
    } else if (now - begun > patience) {
      ::kill(pid, SIGKILL);
    }
  }
}

/// The exit code of the last Node; a signal that ended it ends this program too.
int read_with_node(uint64_t memory, const std::string& file, double patience) {
  constexpr size_t max_skipped = 50;
  limit_data(memory, name);
  ::unsetenv("NODE_OPTIONS");
  check_threads();
  const CurrentProduct current;
  Program program = node_program(memory, file, current.descriptor());
  for (size_t skipped = 0;; ++skipped) {
    const int status = wait_for(start_program(program, program.file), current, patience);
    if (!WIFSIGNALED(status)) return WEXITSTATUS(status);
    const uint32_t product = current.number();
    const int signal = WTERMSIG(status);
    // Node aborts and traps where it gets no memory: that is no product's fault.
    if (product == 0 || signal == SIGABRT || signal == SIGTRAP || skipped == max_skipped) {
      ::signal(signal, SIG_DFL);
      ::raise(signal);
    }
    program.words.push_back(std::to_string(product));
    if (::ftruncate(3, 0) != 0 || ::lseek(3, 0, SEEK_SET) != 0)
      fail("IFC", "cannot be read again: {}", std::strerror(errno));
  }
}

}  // namespace

}  // namespace triptych

int main(int count, char** arguments) {
  using namespace triptych;
  try {
    // What the file is its first bytes say, whatever --as does.
    const auto flags = reader_flags(count, arguments, {"--memory", "--patience", "--as"});
    if (!flags) {
      fmt::print(stderr,
                 "triptych: usage: triptych-import-ifc --memory BYTES [--patience SECONDS] [--as .EXTENSION] "
                 "FILE 3>FILE.scene\n");
      return 2;
    }
    const double patience = flags->count("--patience") > 0 ? std::atof(flags->at("--patience").c_str()) : 120;
    return read_with_node(memory_argument(flags->at("--memory")), arguments[count - 1], patience);
  } catch (const std::exception& error) {
    fmt::print(stderr, "triptych: {}\n", error.what());
    return 1;
  }
}
