#include "model/import/converter.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/one_line.hpp"
#include "base/process.hpp"
#include "base/unnamed_file.hpp"
#include "model/import/mesh_stream_source.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace triptych {

namespace {

constexpr std::string_view complaint_prefix = "triptych: ", warning_prefix = "warning: ";
constexpr size_t max_talk = size_t{1} << 16;  ///< bytes of its output that are read

/// A child process that is killed and collected when it goes out of scope.
class Child {
 public:
  explicit Child(pid_t pid) : pid_(pid) {}
  ~Child() {
    if (!running_) return;
    ::kill(pid_, SIGKILL);
    while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Its status when it has ended; nullopt if it is still running after so many seconds.
  std::optional<int> wait(double seconds) {
    const Stopwatch stopwatch;
    int status = 0;
    for (;;) {
      const pid_t ended = ::waitpid(pid_, &status, WNOHANG);
      if (ended == pid_) {
        running_ = false;
        return status;
      }
      if (stopwatch.seconds() > seconds) return std::nullopt;
      ::usleep(1000);
    }
  }

 private:
  pid_t pid_;
  bool running_ = true;
};

std::filesystem::path beside_this_program() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / "triptych-import";
}

/// Everything that the child prints on its standard error until it closes it, or the time is over.
std::string listen(int errors, double seconds) {
  std::string said;
  const Stopwatch stopwatch;
  for (double left = seconds; left > 0; left = seconds - stopwatch.seconds()) {
    pollfd waiting{.fd = errors, .events = POLLIN, .revents = 0};
    if (::poll(&waiting, 1, static_cast<int>(std::min(left, 1.0) * 1000) + 1) <= 0) continue;
    std::array<char, 4096> buffer{};
    const ssize_t count = ::read(errors, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    if (said.size() < max_talk) said.append(buffer.data(), static_cast<size_t>(count));
  }
  return said;
}

/// The bytes in a file without a name.
Descriptor as_file(const std::shared_ptr<const StreamSource>& source, const ImportOptions& options) {
  Descriptor file = open_unnamed_file(options.temporary_folder);
  SourceReader reader(source);
  std::vector<std::byte> block(size_t{1} << 20);
  for (uint64_t offset = 0; offset < source->size();) {
    const auto count = static_cast<size_t>(std::min<uint64_t>(block.size(), source->size() - offset));
    reader.read(offset, std::span(block).first(count));
    write_all(file.number(), std::span(block).first(count), source->name());
    offset += count;
  }
  return file;
}

/// The child's message, which a damaged file may have caused, as one line of printable characters.
std::string plain(std::string_view line) { return one_line(std::string(line.substr(0, 200))); }

}  // namespace

Converted convert_model(const std::filesystem::path& file, const PackedFile* unpacked,
                        const ImportOptions& options) {
  const std::string place = file.string();
  StreamSource exists(file);  // Error if it does not
  const std::filesystem::path program = options.converter.empty() ? beside_this_program() : options.converter;
  if (::access(program.c_str(), X_OK) != 0)
    fail(place, "is of a format that {} reads, which is not there", program.string());

  Descriptor output = open_unnamed_file(options.temporary_folder);
  Pipe errors = open_pipe(place);
  Descriptor input;
  std::vector<std::string> words = {program.string(), "--memory", std::to_string(options.converter_bytes)};
  std::vector<Program::Handed> handed = {{output.number(), 3}, {errors.write.number(), STDERR_FILENO}};
  if (unpacked) {
    input = as_file(unpacked->content, options);
    words.insert(words.end(), {"--as", unpacked->name.extension().string(), "/proc/self/fd/4"});
    handed.push_back({input.number(), 4});
  } else {
    words.push_back(place);
  }
  const Program reader{.file = program.string(),
                       .words = std::move(words),
                       .descriptors = std::move(handed),
                       .death_signal = SIGKILL,
                       .default_signals = {},
                       .ignored_signals = {}};
  Child child(start_program(reader, program.string()));
  errors.write.close();
  const Stopwatch stopwatch;
  const std::string said = listen(errors.read.number(), options.converter_seconds);
  const auto ended = child.wait(options.converter_seconds - stopwatch.seconds());
  if (!ended) fail(place, "takes more than {} s to read; it was given up", options.converter_seconds);
  const int status = *ended;

  Converted converted;
  std::string complaint;
  for (size_t begin = 0; begin < said.size();) {
    const size_t end = std::min(said.find('\n', begin), said.size());
    const std::string_view line = std::string_view(said).substr(begin, end - begin);
    if (line.starts_with(warning_prefix)) {
      converted.warnings.push_back(plain(line.substr(warning_prefix.size())));
    } else if (line.starts_with(complaint_prefix)) {
      complaint = plain(line.substr(complaint_prefix.size()));
    }
    begin = end + 1;
  }
  if (WIFSIGNALED(status)) {
    fail(place, "makes its reader crash (signal {}, {}); the file is damaged, or Assimp cannot read it",
         WTERMSIG(status), ::strsignal(WTERMSIG(status)));
  }
  if (WEXITSTATUS(status) != 0) {
    fail(place, "{}",
         complaint.empty() ? fmt::format("its reader ended with exit code {}", WEXITSTATUS(status))
                           : complaint);
  }
  converted.glb = std::make_shared<StreamSource>(place, std::move(output));
  return converted;
}

}  // namespace triptych
