#include "measure/accuracy/butteraugli.hpp"

#include "base/error.hpp"
#include "base/process.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <fcntl.h>
#include <string>
#include <string_view>
#include <sys/wait.h>
#include <unistd.h>

namespace triptych {

namespace {

std::string read_all(int descriptor) {
  std::string text;
  std::array<char, 4096> buffer;
  for (;;) {
    const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer.data(), static_cast<size_t>(count));
  }
}

}  // namespace

std::optional<Butteraugli> Butteraugli::find() {
  const std::string program = find_program("butteraugli_main");
  return program.empty() ? std::nullopt : std::optional(Butteraugli(program));
}

double Butteraugli::distance(const std::filesystem::path& reference,
                             const std::filesystem::path& shown) const {
  Pipe output = open_pipe(program_.string());
  const Descriptor nowhere(::open("/dev/null", O_WRONLY | O_CLOEXEC));
  Program program;
  program.file = program_.string();
  program.words = {program_.filename().string(), reference.string(), shown.string()};
  program.descriptors = {{output.write.number(), 1}, {nowhere.number(), 2}};
  const pid_t child = start_program(program, program_.string());
  output.write.close();
  const std::string text = read_all(output.read.number());
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  static constexpr std::string_view key = "3-norm: ";
  const size_t at = text.find(key);
  double value = 0;
  const char* const first = text.data() + at + key.size();
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || at == std::string::npos ||
      std::from_chars(first, text.data() + text.size(), value).ec != std::errc())
    fail(program_.string(), "cannot compare {} with {}", shown.string(), reference.string());
  return value;
}

}  // namespace triptych
