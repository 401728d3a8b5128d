// triptych-import-ifc: reads one IFC file and writes a scene stream to descriptor 3 (docs/formats.md). It
// limits itself, and becomes Node, which runs web-ifc (read_ifc.mjs). triptych starts it
// (model/import/converter.hpp).
#include "base/error.hpp"
#include "launch/reader_limits.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <unistd.h>

namespace triptych {

namespace {

constexpr std::string_view name = "triptych-import-ifc";

/// The scripts and web-ifc: beside this program, in the build folder as where it is installed.
std::filesystem::path reader_folder() {
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  return program.parent_path().parent_path() / "share/triptych/ifc";
}

/// The first file of this name on the PATH; empty if there is none.
std::string find_program(const std::string& program) {
  const char* const path = std::getenv("PATH");
  std::string_view left = path ? path : "/usr/local/bin:/usr/bin:/bin";
  while (!left.empty()) {
    const size_t end = std::min(left.find(':'), left.size());
    std::string file = fmt::format("{}/{}", left.substr(0, end), program);
    if (end > 0 && ::access(file.c_str(), X_OK) == 0) return file;
    left.remove_prefix(std::min(end + 1, left.size()));
  }
  return "";
}

[[noreturn]] void become_node(uint64_t memory, const std::string& file) {
  const std::string node = find_program("node");
  if (node.empty())
    fail("IFC", "is read by Node, which is not installed: run launch/install, or apt-get install nodejs");
  const std::filesystem::path folder = reader_folder();
  if (!std::filesystem::exists(folder / "node_modules/web-ifc/web-ifc-node.wasm"))
    fail("IFC", "is read by web-ifc, which is not there: run launch/install, or npm ci in {}",
         folder.string());
  limit_data(memory, name);
  ::unsetenv("NODE_OPTIONS");
  ::dup2(STDERR_FILENO, STDOUT_FILENO);  // nothing of what the libraries print is ours
  // Most of the memory is WebAssembly's; the heap of objects needs its share.
  const std::string heap = fmt::format("--max-old-space-size={}", std::max<uint64_t>(memory >> 21, 64));
  const std::string script = (folder / "read_ifc.mjs").string();
  const std::array<const char*, 5> words = {node.c_str(), heap.c_str(), script.c_str(), file.c_str(),
                                            nullptr};
  ::execv(node.c_str(), const_cast<char* const*>(words.data()));
  fail("IFC", "Node ({}) cannot be started: {}", node, std::strerror(errno));
}

}  // namespace

}  // namespace triptych

int main(int count, char** arguments) {
  using namespace triptych;
  try {
    if (count != 4 || std::string_view(arguments[1]) != "--memory") {
      fmt::print(stderr, "triptych: usage: triptych-import-ifc --memory BYTES FILE 3>FILE.scene\n");
      return 2;
    }
    become_node(memory_argument(arguments[2]), arguments[3]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "triptych: {}\n", error.what());
    return 1;
  }
}
